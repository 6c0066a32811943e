// One louse through one tick: an integrator's steps (integrators.h, precise.h) with the sub-step rules
// (sub_step_rules.h), the friction stop and the walls (rim.h, walls.h). ground.h: what acts on the louse.
//
// A sub-step is halved at most to 1/256 of the tick; one that wanted to be shorter still is counted, and its
// energy bounded.
//
// Stop: where friction can hold at v = 0 (the stick test) and |v| + h at <= 0, or v is too small for the
// shortest sub-step to resolve its direction, the louse halts after |v|/(-at). Where it can't hold, it slows,
// turns and goes on; only when v and a are exactly opposite is v = 0 passed, by splitting the sub-step there.
//
// Flight: on a unilateral map the moment at which the normal force ends is located within the sub-step; from
// there the louse flies (flight.h).
//
// Edges that wrap: there are no walls; the sub-step runs over the seam (the surface goes on for some cells
// beyond it), and then the louse is at the opposite rim.
//
// Walls: the crossing is located within the sub-step, the louse bounces and the rest of the tick goes on;
// after kMaxBounces in a tick it keeps no outward velocity and slides.
#pragma once

#include <cmath>

#include "shared/physics/energy_projection.h"
#include "shared/physics/flight.h"
#include "shared/physics/ground.h"
#include "shared/physics/integrators.h"
#include "shared/physics/rim.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/surface_motion.h"
#include "shared/physics/world.h"

namespace woodlouse::physics {

/// S: the surface; F: the Forces the map has; E: the equations; I: the integrator. Equations that are not
/// exact and integrators without sub-steps run bare: no sub-steps, no stop, no rest. Cheap to make, one per
/// batch; refers to `surface`.
template <terrain::Surface S, typename F, typename E = SurfaceEquations, typename I = Nystrom4>
class Stepper {
  static_assert(!E::kExact || terrain::kHasHessian<S>, "the exact equations need the surface's Hessian");

 public:
  /// walls: where the louse is kept (infinite: nowhere), or one period where the edges wrap; tick: [s].
  Stepper(const S& surface, const state::Parameters& parameters, const terrain::Rectangle& walls, double tick)
      : surface_(surface),
        parameters_(parameters),
        ground_(surface, parameters),
        rim_(walls, parameters.edges),
        tick_(tick),
        shortest_(tick / SubStepRules::kMaxSubSteps),
        rules_(parameters, (kKeepsEnergy ? 0.5 : 1.0) * surface.cell(), tick),
        unilateral_(E::kExact && kCurved && parameters.contact == state::SurfaceContact::kUnilateral) {}

  [[nodiscard]] const SubStepRules& rules() const { return rules_; }

  /// Moves the louse through one tick. Its thrust is not counted down here.
  void advance(state::Louse& louse, StepCounters& counters) const {
    ++counters.louse_steps;
    finish(louse, tick_, 0, counters);
  }

  /// The rest of a tick, of which `remaining` [s] is left after `pieces` sub-steps in lanes (batch.h).
  void finish(state::Louse& louse, double remaining, int pieces, StepCounters& counters) const {
    const Drive drive = drive_of(louse);
    const bool turns_with_v = kRules && (F::friction || (F::thrust && drive.along != 0.0));
    I integrator;
    Motion at{louse.position, louse.velocity};
    int bounces = 0;

    for (int piece = pieces; remaining > 0.0; ++piece) {
      if (piece == kMaxPieces) {
        ++counters.capped;
        break;
      }
      if (louse.phase == state::Phase::kFlying) {
        remaining -= fly(louse, at, remaining, counters);
        continue;
      }
      Start start = begin(at, drive, bounces, counters);
      at = start.at;
      if (kRules && start.speed2 == 0.0 && !set_off(start, louse.heading, drive)) {
        louse.phase = state::Phase::kResting;
        break;
      }
      const double speed = std::sqrt(start.speed2);
      double h = remaining;
      while (kRules && h > shortest_ && is_too_long(start, h)) h *= 0.5;
      const bool capped = kRules && h <= shortest_ && is_too_long(start, h);
      ++counters.sub_steps;

      if (turns_with_v && start.speed2 > 0.0 && turns_too_far(start, drive, h)) {
        const double rate = speed_rate(start, speed);
        const bool resolved = limit_turn(start, drive, rate, h);
        const Halt halt = halts(start, speed, rate, h, resolved, louse.heading, drive);
        if (halt != Halt::kNo) {
          const double time = speed < -rate * remaining ? -speed / rate : remaining;
          louse.distance += 0.5 * time * speed;
          louse.heading = direction(at.velocity);
          at = {rim_.stopped(at.position + (0.5 * time) * at.velocity), {}};
          remaining -= time;
          integrator = I{};
          if (halt == Halt::kTurnsBack) continue;
          louse.phase = state::Phase::kResting;
          ++counters.stops;
          break;
        }
      }

      const Field field{ground_, start, drive};
      StepResult step = integrator.step(start, field, h);
      h = h == step.used ? h : step.used;
      Motion& end = step.end;
      if (capped) {
        ++counters.capped;
        end = energy_bounded(start, drive, h, end);
      }
      const bool hits = !rim_.lets_pass(end.position);
      if (hits) {
        h = rim_.reach(h, end, [&](double t) { return integrator.step(start, field, t).end; });
        if (capped) end = energy_bounded(start, drive, h, end);
      }
      if constexpr (kKeepsEnergy) {
        if (!capped && !start.contact.any()) end = energy_kept(start, drive, h, end, hits);
      }
      const bool flies = unilateral_ && takes_off(start, field, integrator, h, end);
      if (flies) {
        const Flight flight = taken_off(surface_.sample(end.position.x, end.position.y), end);
        louse.phase = state::Phase::kFlying;
        louse.flight_z = flight.height;
        louse.flight_vz = flight.climb;
        ++counters.flights;
      }
      if constexpr (requires { integrator.accept(hits); }) integrator.accept(hits || capped || flies);
      louse.distance += h * speed;
      remaining = h == remaining ? 0.0 : remaining - h;
      at = end;
      if (rim_.wraps()) carry_home(at, integrator);
    }
    louse.position = at.position;
    louse.velocity = at.velocity;
    if (dot(at.velocity, at.velocity) > 0.0) louse.heading = direction(at.velocity);
  }

  /// Whether friction, brake and walls hold this louse where it is. False while it moves.
  [[nodiscard]] bool holds(const state::Louse& louse) const {
    if (louse.phase == state::Phase::kFlying || louse.velocity != core::Vec2{}) return false;
    const Drive drive = drive_of(louse);
    Start start;
    start.at = {louse.position, {}};
    start.sample = ground_.site(louse.position);
    start.contact = rim_.touching(louse.position);
    return is_held(start, ground_.balance(start, louse.heading, drive));
  }

 private:
  using Ground = physics::Ground<S, F, E>;
  using Field = physics::Field<Ground>;
  using Start = typename Ground::Start;

  static constexpr bool kCurved = terrain::Curved<typename Ground::Sample>;
  static constexpr bool kRules = E::kExact && I::kSubSteps;
  /// On flat ground the steps themselves are exact where nothing but gravity acts.
  static constexpr bool kKeepsEnergy = E::kExact && I::kKeepsEnergy && kConservative<F> && kCurved;
  static constexpr int kMaxBounces = 8;
  static constexpr int kMaxPieces = 1024;  // sub-steps, impacts and stops of one tick, whatever happens

  enum class Halt { kNo, kRests, kTurnsBack };

  [[nodiscard]] Drive drive_of(const state::Louse& louse) const {
    return F::thrust ? physics::drive_of(louse, parameters_.thrust_max) : Drive{};
  }

  [[nodiscard]] static core::Vec2 direction(core::Vec2 v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

  /// Samples the surface, lets the louse bounce off a wall it is about to leave through, finds a1.
  Start begin(const Motion& at, const Drive& drive, int& bounces, StepCounters& counters) const {
    Start start;
    start.at = at;
    start.sample = ground_.site(at.position);
    start.contact = rim_.touching(at.position);
    if (start.contact.any()) {
      core::Vec2& v = start.at.velocity;
      if (outward(start.contact.x, v.x) || outward(start.contact.y, v.y)) {
        const double restitution = bounces < kMaxBounces ? parameters_.edge_restitution : 0.0;
        v = bounced(start.sample, start.contact, v, restitution);
        ++bounces;
        ++counters.bounces;
      }
      lean_on(start, drive);
    }
    start.speed2 = squared_length_in_space(start.sample, start.at.velocity);
    if (kRules && !(start.speed2 > kStandstill2)) {
      start.at.velocity = {};
      start.speed2 = 0.0;
    }
    start.acceleration = ground_.accelerate(start.sample, start.at.velocity, drive, start.contact);
    return start;
  }

  /// Of the walls that are touched, leaves those in `contact` that the louse leans on: no velocity along
  /// their normals. One that it leaves so slowly that it is back within rounding of the wall, it has not
  /// left: without that, a louse in a corner would bounce off two walls without end.
  void lean_on(Start& start, const Drive& drive) const {
    const Contact touched = start.contact;
    core::Vec2& v = start.at.velocity;
    start.contact = {v.x != 0.0 ? 0 : touched.x, v.y != 0.0 ? 0 : touched.y};
    const Contact left{touched.x - start.contact.x, touched.y - start.contact.y};
    if (!left.any()) return;
    const core::Vec2 a = ground_.accelerate(start.sample, v, drive, start.contact);
    const auto falls_back = [&](int side, double leaving, double pull) {
      return outward(side, pull) && leaving * leaving <= 4.0 * rim_.tolerance() * std::fabs(pull);
    };
    const bool x = falls_back(left.x, v.x, a.x);
    const bool y = falls_back(left.y, v.y, a.y);
    if (!x && !y) return;
    const Contact leans{x ? touched.x : start.contact.x, y ? touched.y : start.contact.y};
    if (leans.x != 0 && leans.y != 0) {
      v = {0.0, 0.0};
    } else {
      v = x ? react_x(start.sample, v, 1.0) : react_y(start.sample, v, 1.0);
    }
    start.contact = leans;
  }

  [[nodiscard]] static bool is_held(const Start& start, const RestingBalance& b) {
    return squared_length_in_space(start.sample, b.pull) <= b.hold * b.hold;
  }

  /// At v = 0: the acceleration out of rest, friction opposing the motion about to begin. False: it is held.
  bool set_off(Start& start, core::Vec2 heading, const Drive& drive) const {
    const RestingBalance b = ground_.balance(start, heading, drive);
    if (is_held(start, b)) return false;
    const double pull = std::sqrt(squared_length_in_space(start.sample, b.pull));
    start.acceleration = (1.0 - b.hold / pull) * b.pull;
    return true;
  }

  [[nodiscard]] bool is_too_long(const Start& start, double h) const {
    if constexpr (F::central) {
      if (SubStepRules::swings_too_far(central_pull(start.at.position, parameters_.central_gravity), h))
        return true;
    }
    return rules_.too_long(start.sample, start.speed2, h);
  }

  [[nodiscard]] bool turns_too_far(const Start& start, const Drive& drive, double h) const {
    const double a2 = squared_length_in_space(start.sample, start.acceleration);
    return SubStepRules::turns_too_far(a2 + rules_.stiffness2(drive.along), start.speed2, h);
  }

  /// d|v|3/dt at the start; REQUIRES speed > 0.
  [[nodiscard]] static double speed_rate(const Start& start, double speed) {
    const auto& s = start.sample;
    const core::Vec2 v = start.at.velocity;
    const core::Vec2 a = start.acceleration;
    const double vz = s.zx * v.x + s.zy * v.y;
    return (dot(v, a) + vz * (s.zx * a.x + s.zy * a.y + curvature_along(s, v))) / speed;
  }

  /// Halves h until v's direction can be trusted, or the shortest sub-step is reached (false); speeding up,
  /// only what acts across v swings it.
  [[nodiscard]] bool limit_turn(const Start& start, const Drive& drive, double rate, double& h) const {
    double a2 = squared_length_in_space(start.sample, start.acceleration) + rules_.stiffness2(drive.along);
    if (rate > 0.0) a2 -= rate * rate;
    while (h > shortest_ && SubStepRules::turns_too_far(a2, start.speed2, h)) h *= 0.5;
    return !SubStepRules::turns_too_far(a2, start.speed2, h);
  }

  /// resolved: as limit_turn says. A louse that is slower than that, and can be held, is at its end; a fast
  /// one whose friction turns with the ground's curvature is not, and friction that holds at v = 0 tells it
  /// apart: by itself it makes |a| at most twice itself.
  [[nodiscard]] Halt halts(const Start& start, double speed, double rate, double h, bool resolved,
                           core::Vec2 heading, const Drive& drive) const {
    const bool stops = !(speed + h * rate > 0.0);
    if (!stops && resolved) return Halt::kNo;
    const RestingBalance balance = ground_.balance(start, heading, drive);
    if (!stops && speed > 20.0 * h * balance.hold) return Halt::kNo;
    if (is_held(start, balance)) return Halt::kRests;
    if (!stops) return Halt::kNo;
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

  /// Over a seam, a louse goes on at the opposite rim.
  void carry_home(Motion& at, I& integrator) const {
    const Turns turns = rim_.carry_home(at.position);
    if constexpr (requires { integrator.carried(surface_, turns); }) integrator.carried(surface_, turns);
  }

  /// One piece of a flight; the time it took.
  double fly(state::Louse& louse, Motion& at, double remaining, StepCounters& counters) const {
    Flight flight{at, louse.flight_z, louse.flight_vz};
    const double speed = std::sqrt(dot(at.velocity, at.velocity) + louse.flight_vz * louse.flight_vz);
    const auto piece = Flyer<S>(surface_, parameters_, rim_, tick_).fly(flight, remaining);
    ++counters.sub_steps;
    if (piece.bounced) ++counters.bounces;
    louse.distance += piece.time * speed;
    at = flight.over;
    if (rim_.wraps()) rim_.carry_home(at.position);
    louse.flight_z = flight.height;
    louse.flight_vz = flight.climb;
    if (piece.landed) {
      at.position = rim_.inside(at.position);
      at.velocity = landed_velocity(surface_.sample(at.position.x, at.position.y), flight);
      louse.phase = state::Phase::kMoving;
      louse.flight_z = louse.flight_vz = 0.0;
    }
    return piece.time < remaining ? piece.time : remaining;
  }

  /// The end, put right to the energy of the start; one at a wall stays there.
  [[nodiscard]] Motion energy_kept(const Start& start, const Drive& drive, double h, const Motion& end,
                                   bool at_wall) const {
    if (at_wall) return energy_bounded(start, drive, h, end);
    const double energy0 = energy(start.sample, start.at.velocity, parameters_.gravity);
    const auto s = surface_.sample(end.position.x, end.position.y);
    const EnergyKept<double> kept = with_energy(energy0, s, end, h, parameters_.gravity);
    return kept.near && rim_.lets_pass(kept.end.position) ? kept.end : energy_bounded(start, drive, h, end);
  }

  /// For a sub-step longer than the rules ask, or far off: a finite end that has no energy from nothing, and
  /// where energy is kept, all of it. Where there is none on its way, the louse turns back.
  [[nodiscard]] Motion energy_bounded(const Start& start, const Drive& drive, double h,
                                      const Motion& end) const {
    const Motion back{start.at.position, -start.at.velocity};
    if (!rim_.admits(end.position)) return back;  // also NaN
    const core::Vec2 place = rim_.inside(end.position);
    const double speed = std::sqrt(start.speed2);
    const double push = drive.push + std::fabs(drive.along);
    const double most =
        0.5 * start.speed2 + parameters_.gravity * start.sample.z + push * (h * speed + 0.5 * h * h * push);
    const auto s = surface_.sample(place.x, place.y);
    const double kinetic = most - parameters_.gravity * s.z;
    const double speed2 = squared_length_in_space(s, end.velocity);
    if (!(kinetic >= 0.0) || !(speed2 < 1e300)) return back;
    if (!kKeepsEnergy && 0.5 * speed2 <= kinetic) return end;
    if (!(speed2 > kStandstill2)) return back;
    return {end.position, std::sqrt(2.0 * kinetic / speed2) * end.velocity};
  }

  const S& surface_;
  const state::Parameters& parameters_;
  Ground ground_;
  Rim rim_;
  double tick_;
  double shortest_;
  SubStepRules rules_;
  bool unilateral_;
};

}  // namespace woodlouse::physics
