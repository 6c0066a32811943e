#include "bench/lab/gains.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
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
constexpr std::uint32_t kLice = 20;
constexpr double kHalf = 6.0;  // [m], of the map's side

struct Force {
  const char* name;
  double drag, friction, central_gravity;
  bool brakes;
};
constexpr std::array kForces = {Force{"none", 0.0, 0.0, 0.0, false},
                                Force{"drag", 0.2, 0.0, 0.0, false},
                                Force{"friction 0.05", 0.0, 0.05, 0.0, false},
                                Force{"friction 0.5", 0.0, 0.5, 0.0, false},
                                Force{"brake", 0.0, 0.0, 0.0, true},
                                Force{"central gravity", 0.0, 0.0, 100.0, false},
                                Force{"central gravity, all", 0.1, 0.2, 100.0, true}};

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

struct Gain {
  double worst = 0.0;
  double rate = 0.0;  ///< at which it was
  double capped = 0.0, sub_steps = 0.0, louse_steps = 0.0;
};

void run(Gain& gain, const std::shared_ptr<const terrain::Terrain>& ground, const state::Parameters& p,
         bool brakes, double rate, double seconds) {
  const bool is_kept = p.drag == 0.0 && p.friction == 0.0 && !brakes;
  const double bottom = lowest(*ground, p);
  physics::World world(ground, p, 1.0 / rate);
  core::Random random(11);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  std::vector<double> reference, scale;
  for (state::LouseId id = 1; id <= kLice; ++id) {
    state::Louse louse = louse_at({symmetric(5.0), symmetric(5.0)}, {symmetric(3.0), symmetric(3.0)});
    louse.id = id;
    world.insert(louse);
    if (brakes) world.set_thrust(id, {state::ThrustKind::kAlongHeading, {-0.5, 0.0}}, state::kHeld);
    reference.push_back(energy(*ground, p, louse));
    scale.push_back(reference.back() - bottom);
  }
  for (long tick = 0; tick < std::lround(seconds * rate); ++tick) {
    world.step();
    for (std::size_t k = 0; k < kLice; ++k) {
      const double now = energy(*ground, p, world.lice()[k]);
      const double gained = (now - reference[k]) / scale[k];
      if (!(gained <= gain.worst)) gain = {gained, rate, gain.capped, gain.sub_steps, gain.louse_steps};
      if (!is_kept) reference[k] = std::fmin(reference[k], now);
    }
  }
  gain.capped += static_cast<double>(world.counters().capped);
  gain.sub_steps += static_cast<double>(world.counters().sub_steps);
  gain.louse_steps += static_cast<double>(world.counters().louse_steps);
}

}  // namespace

Table gains(Effort effort) {
  Table table({"contact", "method", "forces", "ground", "gained", "at_rate", "bound", "capped", "sub_steps"});
  const double seconds = effort == Effort::kQuick ? 5.0 : 100.0;
  Progress progress("gains", kContacts.size() * kMethods.size() * kForces.size() * kRoughnesses.size());
  for (const SurfaceContact contact : kContacts) {
    for (const Method method : kMethods) {
      for (const Force& force : kForces) {
        for (const Roughness& roughness : kRoughnesses) {
          progress.advance();
          if (contact == SurfaceContact::kUnilateral && force.central_gravity > 0.0)
            continue;  // no map has both
          state::Parameters p{9.81, force.drag, force.friction, 4.0, 1.0};
          p.central_gravity = force.central_gravity;
          if (p.central_gravity > 0.0) p.core_radius = physics::default_core_radius(p.central_gravity);
          p.contact = contact;
          p.method = method;
          Gain gain;
          for (const double rate : kRates) run(gain, ground_of(roughness), p, force.brakes, rate, seconds);
          table.add({std::string(state::to_text(contact)), std::string(state::to_text(method)),
                     std::string(force.name), std::string(roughness.name), gain.worst, gain.rate,
                     method == Method::kCheap ? 1e-2 : 1e-3, gain.capped / gain.sub_steps,
                     gain.sub_steps / gain.louse_steps});
        }
      }
    }
  }
  return table;
}

}  // namespace woodlouse::lab
