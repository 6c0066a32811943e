#include "bench/lab/gains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"
#include "shared/core/random.h"
#include "shared/physics/central_gravity.h"
#include "shared/physics/world.h"

namespace woodlouse::lab {
namespace {

using state::Method;
using state::SurfaceContact;

constexpr std::array kRates = {15.0, 60.0, 240.0};
constexpr std::array kMethods = {Method::kStandard, Method::kCheap, Method::kPrecise};
constexpr std::array kContacts = {SurfaceContact::kBilateral, SurfaceContact::kUnilateral};
constexpr std::size_t kKnots = 13;
constexpr double kHalf = 6.0;  // [m], of the map's side

enum class Steering { kNone, kBrake, kChanging };

struct Force {
  const char* name;
  double drag, friction, central_gravity;
  Steering steering;
};
constexpr std::array kForces = {
    Force{"none", 0.0, 0.0, 0.0, Steering::kNone},
    Force{"drag", 0.2, 0.0, 0.0, Steering::kNone},
    Force{"friction 0.05", 0.0, 0.05, 0.0, Steering::kNone},
    Force{"friction 0.5", 0.0, 0.5, 0.0, Steering::kNone},
    Force{"brake", 0.0, 0.0, 0.0, Steering::kBrake},
    Force{"changing thrust", 0.0, 0.0, 0.0, Steering::kChanging},
    Force{"changing thrust, friction", 0.1, 0.2, 0.0, Steering::kChanging},
    Force{"central gravity", 0.0, 0.0, 100.0, Steering::kNone},
    Force{"central gravity, brake", 0.1, 0.2, 100.0, Steering::kBrake},
    Force{"central gravity, changing thrust", 0.1, 0.2, 100.0, Steering::kChanging}};

struct Roughness {
  const char* name;
  double height;  ///< [m], of knots a metre apart
};
constexpr std::array kRoughnesses = {Roughness{"smooth", 0.6}, Roughness{"rough", 3.0},
                                     Roughness{"wild", 20.0}};

std::shared_ptr<const terrain::Terrain> ground_of(const Roughness& roughness) {
  terrain::HeightGrid grid;
  grid.columns = grid.rows = kKnots;
  grid.x_origin = grid.y_origin = -kHalf;
  grid.dx = grid.dy = 1.0;
  core::Random random(7);
  for (std::size_t k = 0; k < kKnots * kKnots; ++k)
    grid.heights.push_back(roughness.height * (random.uniform() - 0.5));
  return std::make_shared<const terrain::Terrain>(terrain::BicubicSpline(grid));
}

double potential(const state::Parameters& p, core::Vec2 x, double z) {
  const double height = p.gravity * z;
  return p.central_gravity > 0.0 ? height + physics::central_potential(x, p) : height;
}

double energy(const terrain::Terrain& ground, const state::Parameters& p, const state::Louse& louse) {
  const core::Vec2 x = louse.position;
  const core::Vec2 v = louse.velocity;
  const terrain::SurfaceSample s = ground.sample(x.x, x.y);
  const bool flies = louse.phase == state::Phase::kFlying;
  const double vz = state::vertical_speed(louse, {s.zx, s.zy});
  return 0.5 * (dot(v, v) + vz * vz) + potential(p, x, flies ? louse.flight_z : s.z);
}

/// The least energy that a louse can have, but for what lies between the places looked at.
double lowest(const terrain::Terrain& ground, const state::Parameters& p) {
  double least = std::numeric_limits<double>::infinity();
  for (double x = -kHalf; x <= kHalf; x += 0.05) {
    for (double y = -kHalf; y <= kHalf; y += 0.05)
      least = std::fmin(least, potential(p, {x, y}, ground.sample(x, y).z));
  }
  return least;
}

/// What a thrust does to a louse as it moves [m^2/s^3]: f (h.v + (G.h)(G.v)) / |h|3, the law of
/// docs/physics.md.
double power(const terrain::Terrain& ground, const state::Parameters& p, const state::Louse& louse) {
  const bool brakes = louse.thrust_kind == state::ThrustKind::kAlongHeading && louse.thrust.x <= 0.0;
  if (louse.phase == state::Phase::kFlying || louse.thrust_kind == state::ThrustKind::kNone || brakes)
    return 0.0;
  const core::Vec2 h =
      louse.thrust_kind == state::ThrustKind::kMapVector ? louse.thrust : louse.thrust.x * louse.heading;
  const terrain::SurfaceSample s = ground.sample(louse.position.x, louse.position.y);
  const core::Vec2 slope{s.zx, s.zy};
  const double size = std::sqrt(dot(h, h));
  if (!(size > 0.0)) return 0.0;
  const double along = dot(h, louse.velocity) + dot(slope, h) * dot(slope, louse.velocity);
  return p.thrust_max * size * along / std::hypot(size, dot(slope, h));
}

/// Tells what thrusts pay for: the integral of their power over a tick of a world, along the same way made in
/// shorter steps; by trapezoids, or where a part has an event by the larger of its ends.
class Work {
 public:
  Work(const std::shared_ptr<const terrain::Terrain>& ground, const state::Parameters& p, double step)
      : parts_(std::max(4L, std::lround(step * kFineRate))),
        fine_(ground, p, step / static_cast<double>(parts_)) {}

  /// REQUIRES that world has not stepped yet.
  void foresee(const physics::World& world) {
    fine_.restore(world.lice());
    done_.assign(world.lice().size(), 0.0);
    std::vector<double> before;
    for (const state::Louse& louse : fine_.lice()) before.push_back(power_of(louse));
    for (long part = 0; part < parts_; ++part) {
      fine_.step();
      for (std::size_t k = 0; k < done_.size(); ++k) {
        const double after = power_of(fine_.lice()[k]);
        const double mean =
            fine_.events()[k] == 0 ? 0.5 * (before[k] + after) : std::fmax(0.0, std::fmax(before[k], after));
        done_[k] += mean * fine_.step_seconds();
        before[k] = after;
      }
    }
  }

  /// Whether louse k went the foreseen way, looking where it was foreseen to look, to its end: else no power
  /// along it is known.
  [[nodiscard]] bool foresaw(std::size_t k, const state::Louse& end) const {
    const state::Louse& seen = fine_.lice()[k];
    return distance(seen.position, end.position) < kAstray && seen.phase == end.phase;
  }
  [[nodiscard]] double done(std::size_t k) const { return done_[k]; }

 private:
  static constexpr double kFineRate = 480.0;  // [1/s]
  static constexpr double kAstray = 1e-3;     // [m], of the ends

  double power_of(const state::Louse& louse) const {
    return power(fine_.terrain(), fine_.parameters(), louse);
  }

  long parts_;
  physics::World fine_;
  std::vector<double> done_;
};

/// Every kind of thrust, by chance; a brake now and then.
state::Thrust some_thrust(core::Random& random) {
  const auto symmetric = [&] { return 2.0 * random.uniform() - 1.0; };
  const double kind = random.uniform();
  const core::Vec2 value{symmetric(), symmetric()};
  if (kind < 0.1) return {};
  if (kind < 0.4) return {state::ThrustKind::kAlongHeading, {value.x, 0.0}};
  return {state::ThrustKind::kMapVector, dot(value, value) <= 1.0 ? value : 0.5 * value};
}

struct Gain {
  double worst = 0.0;
  double rate = 0.0;  ///< at which it was
  double capped = 0.0, sub_steps = 0.0, louse_steps = 0.0;
  double ticks = 0.0, unforeseen = 0.0;  ///< of lice under a changing thrust

  void note(double gained, double at) {
    if (gained <= worst || std::isnan(worst)) return;  // a NaN stays: no bound admits it
    worst = gained;
    rate = at;
  }
};

/// Lice of one cell at one rate: each one's energy beside what it was given.
class Lice {
 public:
  Lice(std::shared_ptr<const terrain::Terrain> ground, const state::Parameters& p, Steering steering,
       double rate, std::uint32_t lice)
      : steering_(steering),
        rate_(rate),
        is_kept_(p.drag == 0.0 && p.friction == 0.0 && steering != Steering::kBrake),
        world_(ground, p, 1.0 / rate),
        work_(ground, p, 1.0 / rate) {
    bottom_ = lowest(*ground, p);
    core::Random random(11);
    const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
    for (state::LouseId id = 1; id <= lice; ++id) {
      state::Louse louse = louse_at({symmetric(5.0), symmetric(5.0)}, {symmetric(3.0), symmetric(3.0)});
      louse.id = id;
      world_.insert(louse);
      if (steering == Steering::kBrake)
        world_.set_thrust(id, {state::ThrustKind::kAlongHeading, {-0.5, 0.0}}, state::kHeld);
      reference_.push_back(energy(*ground, p, louse));
      scale_.push_back(reference_.back() - bottom_);
    }
  }

  void step(Gain& gain) {
    const std::vector<state::Louse> before(world_.lice().begin(), world_.lice().end());
    if (steering_ == Steering::kChanging) {
      for (const state::Louse& louse : before)
        world_.set_thrust(louse.id, some_thrust(thrusts_), state::kHeld);
      work_.foresee(world_);
    }
    world_.step();
    for (std::size_t k = 0; k < before.size(); ++k) {
      const state::Louse& louse = world_.lice()[k];
      const bool is_paid =
          steering_ != Steering::kChanging || pay(k, louse.distance - before[k].distance, gain);
      const double now = energy(world_.terrain(), world_.parameters(), louse);
      gain.note((now - reference_[k]) / scale_[k], rate_);
      if (!is_kept_ || !is_paid) reference_[k] = std::fmin(reference_[k], now);
    }
  }

  void count(Gain& gain) const {
    gain.capped += static_cast<double>(world_.counters().capped);
    gain.sub_steps += static_cast<double>(world_.counters().sub_steps);
    gain.louse_steps += static_cast<double>(world_.counters().louse_steps);
  }

 private:
  /// Adds what the tick's thrust can have given; false where that is only a bound, all of it along the way.
  bool pay(std::size_t k, double way, Gain& gain) {
    const state::Louse& louse = world_.lice()[k];
    const bool foresaw = work_.foresaw(k, louse);
    reference_[k] += foresaw
                         ? work_.done(k)
                         : world_.parameters().thrust_max * std::sqrt(dot(louse.thrust, louse.thrust)) * way;
    scale_[k] = std::fmax(scale_[k], reference_[k] - bottom_);
    gain.ticks += 1.0;
    gain.unforeseen += foresaw ? 0.0 : 1.0;
    return foresaw;
  }

  Steering steering_;
  double rate_;
  bool is_kept_;  ///< whether the energy is, but for the thrusts' work
  physics::World world_;
  Work work_;
  core::Random thrusts_{13};
  double bottom_;
  std::vector<double> reference_;  ///< the energy that a louse may have, of what it had and was given
  std::vector<double> scale_;      ///< the most of that, above the bottom
};

struct Cell {
  SurfaceContact contact;
  Method method;
  const Force& force;
  const Roughness& roughness;
};

std::vector<Cell> cells() {
  std::vector<Cell> all;
  for (const SurfaceContact contact : kContacts) {
    for (const Method method : kMethods) {
      for (const Force& force : kForces) {
        if (contact == SurfaceContact::kUnilateral && force.central_gravity > 0.0)
          continue;  // no map has both
        for (const Roughness& roughness : kRoughnesses) all.push_back({contact, method, force, roughness});
      }
    }
  }
  return all;
}

Gain gain_of(const Cell& cell, double seconds, std::uint32_t lice_count) {
  state::Parameters p{9.81, cell.force.drag, cell.force.friction, 4.0, 1.0};
  p.central_gravity = cell.force.central_gravity;
  if (p.central_gravity > 0.0) p.core_radius = physics::default_core_radius(p.central_gravity);
  p.contact = cell.contact;
  p.method = cell.method;
  Gain gain;
  for (const double rate : kRates) {
    Lice lice(ground_of(cell.roughness), p, cell.force.steering, rate, lice_count);
    for (long tick = 0; tick < std::lround(seconds * rate); ++tick) lice.step(gain);
    lice.count(gain);
  }
  return gain;
}

}  // namespace

Table gains(Effort effort) {
  Table table({"contact", "method", "forces", "ground", "gained", "at_rate", "bound", "capped", "sub_steps",
               "unforeseen"});
  const double seconds = effort == Effort::kQuick ? 5.0 : 100.0;
  const std::uint32_t lice_count = effort == Effort::kQuick ? 7 : 20;
  const std::vector<Cell> all = cells();
  std::vector<Gain> gains(all.size());
  Progress progress("gains", all.size());
  side_by_side(
      all.size(), [&](std::size_t i) { gains[i] = gain_of(all[i], seconds, lice_count); },
      [&] { progress.advance(); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Gain& gain = gains[i];
    table.add({std::string(state::to_text(all[i].contact)), std::string(state::to_text(all[i].method)),
               std::string(all[i].force.name), std::string(all[i].roughness.name), gain.worst, gain.rate,
               all[i].method == Method::kCheap ? 1e-2 : 1e-3, gain.capped / gain.sub_steps,
               gain.sub_steps / gain.louse_steps, gain.ticks > 0.0 ? gain.unforeseen / gain.ticks : 0.0});
  }
  return table;
}

}  // namespace woodlouse::lab
