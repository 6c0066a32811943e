// One louse through one tick: an integrator's steps (integrators.h, precise.h) with the sub-step rules
// (sub_step_rules.h), the friction stop (halt.h) and the walls (rim.h, walls.h). ground.h: what acts on the
// louse.
//
// A sub-step is halved at most to 1/256 of the tick; one that wanted to be shorter still is counted, and its
// energy bounded.
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

#include "shared/physics/bounded_energy.h"
#include "shared/physics/energy_projection.h"
#include "shared/physics/flight.h"
#include "shared/physics/ground.h"
#include "shared/physics/halt.h"
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
        rules_(parameters, (kKeepsEnergy ? 0.5 : 1.0) * surface.cell(), tick),
        unilateral_(E::kExact && kCurved && parameters.contact == state::SurfaceContact::kUnilateral) {}

  [[nodiscard]] const SubStepRules& rules() const { return rules_; }

  /// Moves the louse through one tick. Its thrust is not counted down here.
  [[gnu::always_inline]] inline void advance(state::Louse& louse, StepCounters& counters) const {
    ++counters.louse_steps;
    run(louse, tick_, 0, counters);
  }

  /// The rest of a tick, of which `remaining` [s] is left after `pieces` sub-steps in lanes (batch.h).
  void finish(state::Louse& louse, double remaining, int pieces, StepCounters& counters) const {
    run(louse, remaining, pieces, counters);
  }

  /// Whether friction, brake and walls hold this louse where it is. False while it moves, and of bare steps.
  [[nodiscard]] bool holds(const state::Louse& louse) const {
    if constexpr (!kRules) return false;
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

  /// A louse on its way through what is left of the tick: the locals of run(), so that each that can be
  /// stays in a register.
  struct Way {
    state::Louse& louse;
    StepCounters& counters;
    const Drive& drive;
    Motion& at;
    double& remaining;  ///< [s]
    int& bounces;       ///< so far, in this tick
    I& integrator;
  };

  /// A sub-step on the ground.
  struct SubStep {
    double h;      ///< [s]
    double speed;  ///< |v|3 at its start [m/s]
    bool capped;   ///< it wanted to be shorter
  };

  /// See finish(). Inlined where lice are stepped one after the other.
  [[gnu::always_inline]] inline void run(state::Louse& louse, double remaining, int pieces,
                                         StepCounters& counters) const {
    const Drive drive = drive_of(louse);
    Motion at{louse.position, louse.velocity};
    int bounces = 0;
    I integrator;
    const Way way{louse, counters, drive, at, remaining, bounces, integrator};
    for (int piece = pieces; remaining > 0.0; ++piece) {
      if (piece == kMaxPieces) {
        ++counters.capped;
        break;
      }
      if (louse.phase == state::Phase::kFlying) {
        const Flyer<S> flyer(surface_, parameters_, rim_, tick_);
        remaining -= fly_on(flyer, louse, at, remaining, counters);
      } else if (!slide(way)) {
        break;
      }
    }
    louse.position = at.position;
    louse.velocity = at.velocity;
    if (dot(at.velocity, at.velocity) > 0.0) louse.heading = direction(at.velocity);
  }

  /// One sub-step on the ground, or up to a halt. False: the louse has come to rest.
  [[gnu::always_inline]] inline bool slide(const Way& way) const {
    Start start = begin(way.at, way.drive, way.bounces, way.counters);
    way.at = start.at;
    if (kRules && start.speed2 == 0.0 && !set_off(ground_, start, way.louse.heading, way.drive)) {
      way.louse.phase = state::Phase::kResting;
      return false;
    }
    SubStep step = choose(start, way.remaining);
    ++way.counters.sub_steps;
    if (turns_with_v(way.drive) && start.speed2 > 0.0 && turns_too_far(rules_, start, way.drive, step.h)) {
      const Turning turning = limit_turn(rules_, start, way.drive, step.speed, step.h);
      step.h = turning.h;
      const Halt halt = halts(ground_, start, turning, way.louse.heading, way.drive);
      if (halt != Halt::kNo) return come_to_halt(way, turning, halt);
    }
    integrate(Field{ground_, start, way.drive}, way, step);
    return true;
  }

  /// A force turns with v, and a sub-step may be too long for it.
  [[nodiscard, gnu::always_inline]] static inline bool turns_with_v(const Drive& drive) {
    return kRules && (F::friction || (F::thrust && drive.along != 0.0));
  }

  /// The longest of remaining, its half, its quarter ... that the rules allow.
  [[nodiscard, gnu::always_inline]] inline SubStep choose(const Start& start, double remaining) const {
    double h = remaining;
    while (kRules && h > rules_.shortest() && is_too_long(start, h)) h *= 0.5;
    const bool capped = kRules && h <= rules_.shortest() && is_too_long(start, h);
    return {h, std::sqrt(start.speed2), capped};
  }

  /// Slows the louse down to v = 0, as far as the tick lasts. False: it rests there.
  [[gnu::always_inline]] inline bool come_to_halt(const Way& way, const Turning& turning, Halt halt) const {
    const auto [speed, rate, h, resolved] = turning;
    const double time = speed < -rate * way.remaining ? -speed / rate : way.remaining;
    way.louse.distance += 0.5 * time * speed;
    way.louse.heading = direction(way.at.velocity);
    way.at = {rim_.stopped(way.at.position + (0.5 * time) * way.at.velocity), {}};
    way.remaining -= time;
    way.integrator = I{};
    if (halt == Halt::kTurnsBack) return true;
    way.louse.phase = state::Phase::kResting;
    ++way.counters.stops;
    return false;
  }

  /// The integrator's step, up to where it meets a wall or takes off.
  [[gnu::always_inline]] inline void integrate(const Field& field, const Way& way, SubStep step) const {
    StepResult result = way.integrator.step(field.start, field, step.h);
    step.h = step.h == result.used ? step.h : result.used;
    Motion& end = result.end;
    const bool hits = put_right(field, way, step, end);
    const bool flies = unilateral_ && takes_off(field, way.integrator, step.h, end);
    if (flies) begin_flight(surface_, end, way.louse, way.counters);
    if constexpr (requires { way.integrator.accept(hits); }) {
      way.integrator.accept(hits || step.capped || flies);
    }
    way.louse.distance += step.h * step.speed;
    way.remaining = step.h == way.remaining ? 0.0 : way.remaining - step.h;
    way.at = end;
    if (rim_.wraps()) carry_home(way.at, way.integrator);
  }

  /// The end within the walls and with no more energy than it may have; whether a wall is met, where step.h
  /// then ends.
  [[gnu::always_inline]] inline bool put_right(const Field& field, const Way& way, SubStep& step,
                                               Motion& end) const {
    const Start& start = field.start;
    if (step.capped) {
      ++way.counters.capped;
      end = bounded(start, way.drive, step.h, end);
    }
    const bool hits = !rim_.lets_pass(end.position);
    if (hits) {
      step.h = rim_.reach(step.h, end, [&](double t) { return way.integrator.step(start, field, t).end; });
      if (step.capped) end = bounded(start, way.drive, step.h, end);
    }
    if constexpr (kKeepsEnergy) {
      if (!step.capped && !start.contact.any()) end = energy_kept(start, way.drive, step.h, end, hits);
    }
    return hits;
  }

  /// Over a seam, a louse goes on at the opposite rim.
  void carry_home(Motion& at, I& integrator) const {
    const Turns turns = rim_.carry_home(at.position);
    if constexpr (requires { integrator.carried(surface_, turns); }) integrator.carried(surface_, turns);
  }

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

  [[nodiscard]] bool is_too_long(const Start& start, double h) const {
    if constexpr (F::central) {
      if (SubStepRules::swings_too_far(central_pull(start.at.position, parameters_.central_gravity), h))
        return true;
    }
    return rules_.too_long(start.sample, start.speed2, h);
  }

  /// Whether the normal force ends within the sub-step; then h and end become those of that moment.
  bool takes_off(const Field& field, I& integrator, double& h, Motion& end) const {
    const Start& start = field.start;
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

  /// The end, put right to the energy of the start; one at a wall stays there.
  [[nodiscard]] Motion energy_kept(const Start& start, const Drive& drive, double h, const Motion& end,
                                   bool at_wall) const {
    if (at_wall) return bounded(start, drive, h, end);
    const double energy0 = energy(start.sample, start.at.velocity, parameters_.gravity);
    const auto s = surface_.sample(end.position.x, end.position.y);
    const EnergyKept<double> kept = with_energy(energy0, s, end, h, parameters_.gravity);
    return kept.near && rim_.lets_pass(kept.end.position) ? kept.end : bounded(start, drive, h, end);
  }

  /// For a sub-step longer than the rules ask, or far off.
  [[nodiscard]] Motion bounded(const Start& start, const Drive& drive, double h, const Motion& end) const {
    return energy_bounded<kKeepsEnergy>(surface_, rim_, parameters_.gravity, start, drive, h, end);
  }

  const S& surface_;
  const state::Parameters& parameters_;
  Ground ground_;
  Rim rim_;
  double tick_;
  SubStepRules rules_;
  bool unilateral_;
};

}  // namespace woodlouse::physics
