// One louse through one tick: an integrator's steps (integrators.h, precise.h) with the sub-step rules
// (sub_step_rules.h), the friction stop and the walls (walls.h).
//
// A sub-step is halved at most to 1/256 of the tick; one that wanted to be shorter still is counted, and its
// energy bounded.
//
// Stop: where friction can hold at v = 0 (the stick test) and |v| + h at <= 0, the louse halts after |v|/(-at).
// Where it can't hold, it slows, turns and goes on; only when v and a are exactly opposite is v = 0 passed, by
// splitting the sub-step there.
//
// Flight: on a unilateral map the moment at which the normal force ends is located within the sub-step; from there
// the louse flies (flight.h).
//
// Walls: the crossing is located within the sub-step, the louse bounces and the rest of the tick goes on; after
// kMaxBounces in a tick it keeps no outward velocity and slides.
#pragma once

#include <cmath>
#include <type_traits>

#include "shared/physics/flight.h"
#include "shared/physics/integrators.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/surface_motion.h"
#include "shared/physics/walls.h"
#include "shared/physics/world.h"

namespace woodlouse::physics {

/// S: the surface; F: the Forces the map has; E: the equations; I: the integrator. Equations that are not exact
/// and integrators without sub-steps run bare: no sub-steps, no stop, no rest. Cheap to make, one per batch;
/// refers to `surface`.
template <terrain::Surface S, typename F, typename E = SurfaceEquations, typename I = Nystrom4>
class Stepper {
  static_assert(!E::kExact || terrain::kHasHessian<S>, "the exact equations need the surface's Hessian");

 public:
  /// walls: where the louse is kept (infinite: nowhere); tick: [s].
  Stepper(const S& surface, const Parameters& parameters, const terrain::Rectangle& walls, double tick)
      : surface_(surface),
        parameters_(parameters),
        walls_(walls),
        tick_(tick),
        shortest_(tick / kMaxSubSteps),
        wall_tolerance_(1e-13 * (walls.x_max - walls.x_min + walls.y_max - walls.y_min)),
        rules_(parameters, surface.cell(), tick),
        unilateral_(E::kExact && parameters.contact == SurfaceContact::kUnilateral) {}

  /// Moves the louse through one tick. Its thrust is not counted down here.
  void advance(Louse& louse, StepCounters& counters) const {
    const Drive drive = drive_of(louse);
    const bool turns_with_v = kRules && (F::friction || (F::thrust && drive.along != 0.0));
    I integrator;
    Motion at{louse.position, louse.velocity};
    double remaining = tick_;
    int bounces = 0;
    ++counters.louse_steps;

    for (int piece = 0; remaining > 0.0; ++piece) {
      if (piece == kMaxPieces) {
        ++counters.capped;
        break;
      }
      if (louse.phase == Phase::kFlying) {
        remaining -= fly(louse, at, remaining, counters);
        continue;
      }
      Start start = begin(at, drive, bounces, counters);
      at = start.at;
      if (kRules && start.speed2 == 0.0 && !set_off(start, louse.heading, drive)) {
        louse.phase = Phase::kResting;
        break;
      }
      const double speed = std::sqrt(start.speed2);
      double h = remaining;
      while (kRules && h > shortest_ && is_too_long(start, h)) h *= 0.5;
      const bool capped = kRules && h <= shortest_ && is_too_long(start, h);
      ++counters.sub_steps;

      if (turns_with_v && start.speed2 > 0.0 && turns_too_far(start, h)) {
        const double rate = speed_rate(start, speed);
        h = turn_limited(start, rate, h);
        const Halt halt = halts(start, speed, rate, h, louse.heading, drive);
        if (halt != Halt::kNo) {
          const double time = -speed / rate;
          louse.distance += 0.5 * time * speed;
          louse.heading = direction(at.velocity);
          at = {inside_walls(at.position + (0.5 * time) * at.velocity), {}};
          remaining -= time;
          integrator = I{};
          if (halt == Halt::kTurnsBack) continue;
          louse.phase = Phase::kResting;
          ++counters.stops;
          break;
        }
      }

      const Field field{*this, start, drive};
      StepResult step = integrator.step(start, field, h);
      h = h == step.used ? h : step.used;
      Motion& end = step.end;
      if (capped) {
        ++counters.capped;
        end = energy_limited(start, drive, h, end);
      }
      const bool leaves = !walls_.contains(end.position.x, end.position.y);
      if (leaves) {
        h = reach_wall(start, field, integrator, h, end);
        end.position = on_wall(end.position);
      }
      if constexpr (requires { integrator.accept(leaves); }) integrator.accept(leaves || capped);
      if (unilateral_ && takes_off(start, field, integrator, h, end)) {
        const Flight flight = taken_off(surface_.sample(end.position.x, end.position.y), end);
        louse.phase = Phase::kFlying;
        louse.flight_z = flight.height;
        louse.flight_vz = flight.climb;
        ++counters.flights;
      }
      louse.distance += h * speed;
      remaining = h == remaining ? 0.0 : remaining - h;
      at = end;
    }
    louse.position = at.position;
    louse.velocity = at.velocity;
    if (dot(at.velocity, at.velocity) > 0.0) louse.heading = direction(at.velocity);
  }

  /// Whether friction, brake and walls hold this louse where it is. False while it moves.
  [[nodiscard]] bool holds(const Louse& louse) const {
    if (louse.phase == Phase::kFlying || louse.velocity != core::Vec2{}) return false;
    const Drive drive = drive_of(louse);
    Start start;
    start.at = {louse.position, {}};
    start.sample = site(louse.position);
    start.contact = touching(walls_, louse.position);
    return is_held(start, balance(start, louse.heading, drive));
  }

 private:
  static constexpr bool kRules = E::kExact && I::kSubSteps;
  static constexpr double kMaxSubSteps = 256.0;
  static constexpr int kMaxBounces = 8;
  static constexpr int kMaxPieces = 2048;  // sub-steps, impacts and stops of one tick, whatever happens

  /// A surface sample that knows the central pull there.
  struct Pulled : terrain::SurfaceSample {
    core::Vec2 pull;
  };
  using Site = std::conditional_t<F::central, Pulled, terrain::SurfaceSample>;

  [[nodiscard, gnu::always_inline]] inline Site site_of(const terrain::SurfaceSample& s, core::Vec2 x) const {
    if constexpr (F::central) {
      return {s, -central_pull(x, parameters_.central_gravity) * x};
    } else {
      return s;
    }
  }

  [[nodiscard, gnu::always_inline]] inline Site site(core::Vec2 x) const { return site_of(surface_.sample(x.x, x.y), x); }

  /// What a sub-step knows of its start.
  struct Start {
    Motion at;
    Site sample;
    core::Vec2 acceleration;
    double speed2 = 0.0;  ///< |v|3^2
    Contact contact;      ///< the walls it may lean on: no velocity along their normals
  };

  enum class Halt { kNo, kRests, kTurnsBack };

  [[nodiscard]] Drive drive_of(const Louse& louse) const {
    return F::thrust ? physics::drive_of(louse, parameters_.thrust_max) : Drive{};
  }

  [[nodiscard]] static core::Vec2 direction(core::Vec2 v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

  /// The motion's right side, as integrators ask for it.
  struct Field {
    const Stepper& stepper;
    const Start& start;
    const Drive& drive;

    [[nodiscard]] const S& surface() const { return stepper.surface_; }
    [[nodiscard, gnu::always_inline]] inline Site sample(core::Vec2 x) const { return stepper.site(x); }
    /// The same for a sample that was taken otherwise.
    [[nodiscard, gnu::always_inline]] inline Site at(const terrain::SurfaceSample& s, core::Vec2 x) const {
      return stepper.site_of(s, x);
    }
    [[nodiscard, gnu::always_inline]] inline core::Vec2 accelerate(const Site& s, core::Vec2 v) const {
      return stepper.accelerate(s, v, drive, start.contact);
    }
    [[nodiscard]] core::Vec2 kick(const Site& s, core::Vec2 v, double k) const
      requires E::kExact
    {
      const core::Vec2 kicked = implicit_kick<F>(s, v, k, stepper.drive_at(s, drive), stepper.parameters_);
      return start.contact.any() ? bounced(s, start.contact, kicked, 0.0) : kicked;
    }
  };

  /// The drive with the site's pull in it.
  [[nodiscard, gnu::always_inline]] static inline decltype(auto) drive_at(const Site& s, const Drive& drive) {
    if constexpr (F::central) {
      Drive pulled = drive;
      pulled.pull = s.pull;
      return pulled;
    } else {
      return (drive);
    }
  }

  [[nodiscard, gnu::always_inline]] inline core::Vec2 accelerate(const Site& s, core::Vec2 v, const Drive& drive,
                                                                 Contact contact) const {
    const core::Vec2 a = E::template acceleration<F>(s, v, drive_at(s, drive), parameters_);
    return contact.any() ? supported(s, contact, a) : a;
  }

  /// Samples the surface, lets the louse bounce off a wall it is about to leave through, finds a1.
  Start begin(const Motion& at, const Drive& drive, int& bounces, StepCounters& counters) const {
    Start start;
    start.at = at;
    start.sample = site(at.position);
    start.contact = touching(walls_, at.position);
    if (start.contact.any()) {
      core::Vec2& v = start.at.velocity;
      if (outward(start.contact.x, v.x) || outward(start.contact.y, v.y)) {
        const double restitution = bounces < kMaxBounces ? parameters_.edge_restitution : 0.0;
        v = bounced(start.sample, start.contact, v, restitution);
        ++bounces;
        ++counters.bounces;
      }
      if (v.x != 0.0) start.contact.x = 0;
      if (v.y != 0.0) start.contact.y = 0;
    }
    start.acceleration = accelerate(start.sample, start.at.velocity, drive, start.contact);
    start.speed2 = squared_length_in_space(start.sample, start.at.velocity);
    return start;
  }

  [[nodiscard]] RestingBalance balance(const Start& start, core::Vec2 heading, const Drive& drive) const {
    RestingBalance b = resting_balance<F>(start.sample, heading, drive_at(start.sample, drive), parameters_);
    if (start.contact.any()) b.pull = supported(start.sample, start.contact, b.pull);
    return b;
  }

  [[nodiscard]] static bool is_held(const Start& start, const RestingBalance& b) {
    return squared_length_in_space(start.sample, b.pull) <= b.hold * b.hold;
  }

  /// At v = 0: the acceleration out of rest, friction opposing the motion about to begin. False: it is held.
  bool set_off(Start& start, core::Vec2 heading, const Drive& drive) const {
    const RestingBalance b = balance(start, heading, drive);
    if (is_held(start, b)) return false;
    const double pull = std::sqrt(squared_length_in_space(start.sample, b.pull));
    start.acceleration = (1.0 - b.hold / pull) * b.pull;
    return true;
  }

  [[nodiscard]] bool is_too_long(const Start& start, double h) const {
    if constexpr (F::central) {
      if (SubStepRules::swings_too_far(central_pull(start.at.position, parameters_.central_gravity), h)) return true;
    }
    return rules_.too_long(start.sample, start.speed2, h);
  }

  [[nodiscard]] static bool turns_too_far(const Start& start, double h) {
    return SubStepRules::turns_too_far(squared_length_in_space(start.sample, start.acceleration), start.speed2, h);
  }

  /// d|v|3/dt at the start; REQUIRES speed > 0.
  [[nodiscard]] static double speed_rate(const Start& start, double speed) {
    const auto& s = start.sample;
    const core::Vec2 v = start.at.velocity;
    const core::Vec2 a = start.acceleration;
    const double vz = s.zx * v.x + s.zy * v.y;
    return (dot(v, a) + vz * (s.zx * a.x + s.zy * a.y + curvature_along(s, v))) / speed;
  }

  /// The longest halving of h in which v's direction can be trusted; speeding up, only what acts across v
  /// swings it.
  [[nodiscard]] double turn_limited(const Start& start, double rate, double h) const {
    double a2 = squared_length_in_space(start.sample, start.acceleration);
    if (rate > 0.0) a2 -= rate * rate;
    while (h > shortest_ && SubStepRules::turns_too_far(a2, start.speed2, h)) h *= 0.5;
    return h;
  }

  [[nodiscard]] Halt halts(const Start& start, double speed, double rate, double h, core::Vec2 heading,
                           const Drive& drive) const {
    if (speed + h * rate > 0.0) return Halt::kNo;
    if (is_held(start, balance(start, heading, drive))) return Halt::kRests;
    const double a2 = squared_length_in_space(start.sample, start.acceleration);
    return a2 - rate * rate <= 1e-12 * a2 ? Halt::kTurnsBack : Halt::kNo;
  }

  /// Whether the normal force ends within the sub-step; then h and end become those of that moment.
  bool takes_off(const Start& start, const Field& field, I& integrator, double& h, Motion& end) const {
    const auto load = [&](const Motion& m) {
      return lift(surface_.sample(m.position.x, m.position.y), m.velocity, parameters_);
    };
    if (!(load(end) < 0.0)) return false;
    double low = 0.0;
    double high = h;
    if (!(lift(start.sample, start.at.velocity, parameters_) > 0.0)) high = 0.0;  // it is due at once
    for (int i = 0; i < 50 && high > 0.0; ++i) {
      const double middle = 0.5 * (low + high);
      (load(integrator.step(start, field, middle).end) < 0.0 ? high : low) = middle;
    }
    end = high > 0.0 ? integrator.step(start, field, high).end : start.at;
    h = high;
    return true;
  }

  /// One piece of a flight; the time it took.
  double fly(Louse& louse, Motion& at, double remaining, StepCounters& counters) const {
    Flight flight{at, louse.flight_z, louse.flight_vz};
    const double speed = std::sqrt(dot(at.velocity, at.velocity) + louse.flight_vz * louse.flight_vz);
    const auto piece = Flyer<S>(surface_, parameters_, walls_, tick_).fly(flight, remaining);
    ++counters.sub_steps;
    if (piece.bounced) ++counters.bounces;
    louse.distance += piece.time * speed;
    at = flight.over;
    louse.flight_z = flight.height;
    louse.flight_vz = flight.climb;
    if (piece.landed) {
      at.position = inside_walls(at.position);
      at.velocity = landed_velocity(surface_.sample(at.position.x, at.position.y), flight);
      louse.phase = Phase::kMoving;
      louse.flight_z = louse.flight_vz = 0.0;
    }
    return piece.time < remaining ? piece.time : remaining;
  }

  /// How far a state lies outside the walls [m] (negative: inside), and how fast it goes on outwards.
  [[nodiscard]] double beyond(const Motion& s, double& leaving) const {
    double distance = walls_.x_min - s.position.x;
    leaving = -s.velocity.x;
    if (const double d = s.position.x - walls_.x_max; d > distance) distance = d, leaving = s.velocity.x;
    if (const double d = walls_.y_min - s.position.y; d > distance) distance = d, leaving = -s.velocity.y;
    if (const double d = s.position.y - walls_.y_max; d > distance) distance = d, leaving = s.velocity.y;
    return distance;
  }

  /// The time after which the louse is at the wall it went through within h; `end` becomes its state there.
  /// Newton's method inside a bracket, repeating the sub-step, so that the state is the integrator's own.
  double reach_wall(const Start& start, const Field& field, I& integrator, double h, Motion& end) const {
    double low = 0.0;
    double high = h;
    double t = h;
    for (int i = 0; i < 60; ++i) {
      double leaving = 0.0;
      const double distance = beyond(end, leaving);
      if (distance >= -wall_tolerance_ && distance <= wall_tolerance_) break;
      (distance > 0.0 ? high : low) = t;
      const double guess = leaving > 0.0 ? t - distance / leaving : low;
      t = guess > low && guess < high ? guess : 0.5 * (low + high);
      end = integrator.step(start, field, t).end;
    }
    return t;
  }

  /// p, put onto the wall that it lies at but for rounding, or beyond.
  [[nodiscard]] core::Vec2 on_wall(core::Vec2 p) const {
    const double margin = 2.0 * wall_tolerance_;
    if (p.x < walls_.x_min + margin) p.x = walls_.x_min;
    if (p.x > walls_.x_max - margin) p.x = walls_.x_max;
    if (p.y < walls_.y_min + margin) p.y = walls_.y_min;
    if (p.y > walls_.y_max - margin) p.y = walls_.y_max;
    return p;
  }

  [[nodiscard]] core::Vec2 inside_walls(core::Vec2 p) const {
    return walls_.contains(p.x, p.y) ? p : on_wall(p);
  }

  /// For a sub-step longer than the rules ask: a finite end that has no energy from nothing. Where there is
  /// none on its way, the louse turns back.
  [[nodiscard]] Motion energy_limited(const Start& start, const Drive& drive, double h, const Motion& end) const {
    const Motion back{start.at.position, -start.at.velocity};
    if (!walls_.contains(end.position.x, end.position.y)) return back;  // also NaN
    const double speed = std::sqrt(start.speed2);
    const double push = drive.push + std::fabs(drive.along);
    const double energy = 0.5 * start.speed2 + parameters_.gravity * start.sample.z +
                          push * (h * speed + 0.5 * h * h * push);
    const terrain::SurfaceSample s = surface_.sample(end.position.x, end.position.y);
    const double kinetic = energy - parameters_.gravity * s.z;
    const double speed2 = squared_length_in_space(s, end.velocity);
    if (!(kinetic >= 0.0) || !(speed2 < 1e300)) return back;
    if (0.5 * speed2 <= kinetic) return end;
    return {end.position, std::sqrt(2.0 * kinetic / speed2) * end.velocity};
  }

  const S& surface_;
  const Parameters& parameters_;
  terrain::Rectangle walls_;
  double tick_;
  double shortest_;
  double wall_tolerance_;
  SubStepRules rules_;
  bool unilateral_;
};

}  // namespace woodlouse::physics
