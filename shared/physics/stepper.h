// One louse through one tick: an integrator's steps (integrators.h, precise.h) by the sub-step rules
// (sub_step_rules.h), friction stop (halt.h), walls (rim.h, walls.h), flight (flight.h); ground.h: what acts.
//
// A sub-step is halved at most to 1/256 of the tick; one that wanted to be shorter still is counted. After
// kMaxSubSteps sub-steps and pieces of flight, or kMaxEvents walls, stops, take-offs and landings, what is
// left of the tick is one such step. No step makes energy (bounded_energy.h), or errs beyond a map's
// tolerance: it is tried again over less. The moment of an event is located within its sub-step, and the rest
// of the tick goes on from there; after kMaxBounces in a tick a louse keeps no velocity into a wall. Over a
// seam a sub-step runs on, then the louse is at the other rim.
#pragma once

#include <cmath>

#include "shared/physics/bounded_energy.h"
#include "shared/physics/flight.h"
#include "shared/physics/ground.h"
#include "shared/physics/halt.h"
#include "shared/physics/heading.h"
#include "shared/physics/integrators.h"
#include "shared/physics/rim.h"
#include "shared/physics/step_counters.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// S: the surface; F: the Forces the map has; E: the equations; I: the integrator. Equations that are not
/// exact and integrators without sub-steps run bare: no sub-steps, no stop, no rest. Refers to `surface`.
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
        keeps_energy_((kMayKeepEnergy || (kRules && F::central)) && conserves_energy(parameters)),
        rules_(parameters, (keeps_energy_ ? 0.5 : 1.0) * surface.cell(), tick),
        unilateral_(E::kExact && kCurved && parameters.contact == state::SurfaceContact::kUnilateral) {}

  [[nodiscard]] const SubStepRules& rules() const { return rules_; }

  /// Moves the louse through one tick; adds what happened to it. Its thrust is not counted down here.
  [[gnu::always_inline]] inline void advance(state::Louse& louse, StepCounters& counters,
                                             state::StepEvents& happened) const {
    ++counters.louse_steps;
    run(louse, tick_, 0, counters, happened);
  }

  /// The rest of a tick: `remaining` [s] after `pieces` sub-steps in lanes (batch.h).
  void finish(state::Louse& louse, double remaining, int pieces, StepCounters& counters,
              state::StepEvents& happened) const {
    run(louse, remaining, pieces, counters, happened);
  }

  /// Whether friction, brake and walls hold this louse where it is. False while it moves, and of bare steps.
  [[nodiscard]] bool holds(const state::Louse& louse) const {
    if constexpr (!kRules) return false;
    if (louse.phase == state::Phase::kFlying || louse.velocity != core::Vec2{}) return false;
    return holds_at(ground_, rim_, louse.position, drive_of(louse));
  }

 private:
  using Ground = physics::Ground<S, F, E>;
  using Field = physics::Field<Ground>;
  using Start = typename Ground::Start;

  static constexpr bool kCurved = terrain::Curved<typename Ground::Sample>;
  static constexpr bool kRules = E::kExact && I::kSubSteps;
  static constexpr bool kTurns = kRules && F::thrust;
  /// On flat ground the steps themselves are exact where nothing but gravity acts.
  static constexpr bool kMayKeepEnergy = E::kExact && I::kKeepsEnergy && (kCurved || F::central);
  static constexpr int kMaxBounces = 8, kMaxEvents = 64;

  /// A louse on its way through the rest of a tick: the locals of run(), which so can stay in registers.
  struct Way {
    state::Louse& louse;
    StepCounters& counters;
    state::StepEvents& happened;
    Drive& drive;
    Motion& at;
    double& remaining;  ///< [s]
    int& bounces;       ///< so far, in this tick
    int& events;        ///< likewise
    double& longest;    ///< of the next sub-step [s]
    I& integrator;
  };

  /// Inlined where lice are stepped one after the other.
  [[gnu::always_inline]] inline void run(state::Louse& louse, double remaining, int pieces,
                                         StepCounters& counters, state::StepEvents& happened) const {
    Drive drive = drive_of(louse);
    Motion at{louse.position, louse.velocity};
    int bounces = 0, events = 0;
    double longest = tick_;
    I integrator;
    const Way way{louse, counters, happened, drive, at, remaining, bounces, events, longest, integrator};
    for (int piece = pieces; remaining > 0.0; ++piece) {
      if (piece >= static_cast<int>(kMaxSubSteps) || events >= kMaxEvents) {
        run_out(way);
        break;
      }
      if (louse.phase == state::Phase::kFlying) {
        fly(way);
      } else if (!slide(way))
        break;
    }
    louse.position = at.position;
    louse.velocity = at.velocity;
    if (drive.turns) {
      louse.heading = drive.direction;
    } else if (dot(at.velocity, at.velocity) > kStandstill2) {
      louse.heading = unit(at.velocity);
    }
  }

  /// One piece in the air, where a heading is the velocity's.
  void fly(const Way& way) const {
    const Flyer<S> flyer(surface_, parameters_, rim_, tick_);
    const auto piece = fly_on(flyer, way.louse, way.at, way.remaining, way.counters, way.happened);
    way.remaining -= piece.time;
    if (piece.landed || piece.bounced) ++way.events;
    follow(way.drive, way.at.velocity);
    if (piece.left) leave(way);
  }

  /// What is left of the tick in one step that looks for nothing on its way, its energy bounded.
  [[gnu::noinline]] void run_out(const Way& way) const {
    ++way.counters.capped;
    if (way.louse.phase == state::Phase::kFlying) {
      const Flyer<S> flyer(surface_, parameters_, rim_, tick_);
      fly_out(flyer, way.louse, way.at, way.remaining, way.counters, way.happened);
      follow(way.drive, way.at.velocity);
    } else {
      const Start start = begin(way);
      const StepResult result = I{}.step(start, Field{ground_, start, way.drive}, way.remaining);
      ++way.counters.sub_steps;
      way.counters.samples += I::kSamples;
      way.at = bounded(start, way.drive, {way.remaining, 0.0, true}, result.end);
      way.louse.distance += way_of_ends(surface_, rim_, start, way.at, way.remaining);
      lag(way.drive, way.at.velocity, way.remaining);
      if (rim_.wraps()) carry_home(way);
      way.at.position = rim_.inside(way.at.position);
    }
    way.remaining = 0.0;
  }

  /// One sub-step on the ground, or up to a halt. False: the louse has come to rest.
  [[gnu::always_inline]] inline bool slide(const Way& way) const {
    Start start = begin(way);
    way.at = start.at;
    if (kRules && start.speed2 == 0.0 && !set_off(ground_, start, way.drive)) {
      rest(way);
      return false;
    }
    if (rim_.lets_out(start.at.position, start.at.velocity, start.acceleration)) return leave(way);
    SubStep step = choose(start, way.drive, way.remaining < way.longest ? way.remaining : way.longest);
    ++way.counters.sub_steps;
    const bool turns_with_v = kRules && (F::friction || (F::thrust && way.drive.along < 0.0));
    if (turns_with_v && start.speed2 > 0.0 && turns_too_far(rules_, start, way.drive, step.h)) {
      const Turning turning = limit_turn(rules_, start, way.drive, step.speed, step.h);
      step.h = turning.h;
      const Halt halt = halts(ground_, start, turning, way.drive);
      if (halt != Halt::kNo) return come_to_halt(way, start, turning, halt);
    }
    integrate(Field{ground_, start, way.drive}, way, step);
    return true;
  }

  /// The longest of h, its half, its quarter ... that the rules allow.
  [[nodiscard, gnu::always_inline]] inline SubStep choose(const Start& start, const Drive& drive,
                                                          double h) const {
    const auto too_long = [&] { return ground_.is_too_long(rules_, start, drive, h); };
    while (kRules && h > rules_.shortest() && too_long()) h = rules_.halved(h);
    const bool capped = kRules && h <= rules_.shortest() && too_long();
    return {h, std::sqrt(start.speed2), capped};
  }

  /// Slows the louse down to v = 0, as far as the tick lasts. False: it rests there.
  [[gnu::always_inline]] inline bool come_to_halt(const Way& way, const Start& start, const Turning& turning,
                                                  Halt halt) const {
    const auto [speed, rate, h, resolved] = turning;
    const double time = speed < -rate * way.remaining ? -speed / rate : way.remaining;
    way.louse.distance += 0.5 * time * speed;
    if (!way.drive.turns) way.louse.heading = unit(way.at.velocity);
    way.at = {halting_place(ground_, rim_, start, 0.5 * time, way.drive.push), {}};
    way.remaining -= time;
    way.integrator = I{};
    ++way.events;
    way.counters.samples += 2;
    if (rim_.lets_out(way.at.position, start.at.velocity, {})) return leave(way);
    // It may have stopped where it is not held, unlike where this step began.
    if (halt == Halt::kTurnsBack || !holds_at(ground_, rim_, way.at.position, way.drive)) return true;
    rest(way);
    ++way.counters.stops;
    return false;
  }

  /// The integrator's step, up to where it meets a wall or takes off. One that makes energy is not taken, but
  /// tried again over half of it.
  [[gnu::always_inline]] inline void integrate(const Field& field, const Way& way, SubStep step) const {
    StepResult result = take_step(field, way, step.h);
    step.h = step.h == result.used ? step.h : result.used;
    double next = tick_;
    if (kRules && rules_.has_tolerance() && !step.capped) {
      way.counters.samples += kLobattoSamples;
      const double error = field.astray(result, step.h);
      const bool borne = rules_.bears(error, step.h);
      if (!borne || way.longest < tick_) next = rules_.borne_length(error, step.h, tick_);
      way.longest = next;
      if (!borne) return;
    }
    const Verdict verdict = judge(field, way, step, result);
    way.longest = verdict == Verdict::kRefused ? rules_.halved(step.h) : next;
    if (verdict == Verdict::kRefused) return;
    const bool hits = meets_wall(field, way, step, result);
    bool flies = false;
    if constexpr (E::kExact) {
      flies = unilateral_ &&
              takes_off(ground_, field, step.h, result, [&](double t) { return take_step(field, way, t); });
    }
    if (verdict == Verdict::kDoubtful || (kRules && (hits || flies)))
      result.end = bounded(field.start, way.drive, step, result.end);
    if (flies) begin_flight(surface_, rim_, result.end, way.louse, way.counters, way.happened);
    if (hits || flies) ++way.events;
    if constexpr (requires { way.integrator.accept(hits); })
      way.integrator.accept(hits || step.capped || flies);
    if (step.capped) result.way = way_of_ends(surface_, rim_, field.start, result.end, step.h);
    way.louse.distance += result.way;
    way.remaining = step.h == way.remaining ? 0.0 : way.remaining - step.h;
    way.at = result.end;
    if (step.capped) {
      lag(way.drive, way.at.velocity, step.h);
    } else if (way.drive.turns) {
      point(way.drive, result.heading);
    }
    if (rim_.wraps()) carry_home(way);
    if (hits && rim_.lets_out(way.at.position, way.at.velocity, {})) leave(way);
  }

  [[gnu::always_inline]] inline StepResult take_step(const Field& field, const Way& way, double h) const {
    way.counters.samples += I::kSamples;
    return way.integrator.step(field.start, field, h);
  }

  /// Looks at a step's energy; puts the end right where that is known.
  [[gnu::always_inline]] inline Verdict judge(const Field& field, const Way& way, const SubStep& step,
                                              StepResult& result) const {
    const Start& start = field.start;
    Motion& end = result.end;
    if (step.capped) {
      ++way.counters.capped;
      if (rim_.is_open() && !rim_.lets_pass(end.position)) return Verdict::kDoubtful;
      end = bounded(start, way.drive, step, end);
      return Verdict::kTaken;
    }
    const Verdict makes_it = step.h > rules_.shortest() ? Verdict::kRefused : Verdict::kDoubtful;
    if constexpr (kMayKeepEnergy) {
      if (brings_to_energy(start, way.drive)) {
        if (!rim_.lets_pass(end.position)) return Verdict::kDoubtful;
        const bool kept = energy_kept<F::central>(ground_, rim_, parameters_, start, step.h, end);
        return kept ? Verdict::kTaken : makes_it;
      }
    }
    if (!kRules || !result.gain.is_told()) return Verdict::kTaken;
    const double share = bearable_gain(step.h);
    // Where sub-steps vary along an orbit, no method's own energy stays bounded.
    const bool varies = !I::kKeepsEnergy && F::central && step.h < tick_ && keeps_energy(way.drive);
    const Verdict fair = varies ? Verdict::kDoubtful : Verdict::kTaken;
    if (result.gain.energy <= share * result.gain.kinetic && rim_.is_here(end.position)) return fair;
    ++way.counters.samples;
    const Gain gain = measured_gain(ground_, rim_, start, way.drive, step.h, result);
    if (gain.energy <= share * gain.kinetic) return fair;
    return is_gross(gain, share, ground_.potential_at(start.at.position, start.sample)) ? makes_it
                                                                                        : Verdict::kDoubtful;
  }

  /// Whether a wall is met, where step.h and the result then end.
  [[gnu::always_inline]] inline bool meets_wall(const Field& field, const Way& way, SubStep& step,
                                                StepResult& result) const {
    if (rim_.lets_pass(result.end.position)) return false;
    step.h = rim_.reach(field.start.at, step.h, result.end, [&](double t) {
      result = take_step(field, way, t);
      return result.end;
    });
    return true;
  }

  /// Over a seam, a louse goes on at the opposite rim.
  void carry_home(const Way& way) const {
    const Turns turns = rim_.carry_home(way.at.position);
    if (turns.any()) way.happened |= state::kCrossedSeam;
    if constexpr (requires { way.integrator.carried(surface_, turns); })
      way.integrator.carried(surface_, turns);
  }

  [[nodiscard]] Drive drive_of(const state::Louse& louse) const {
    return F::thrust ? physics::drive_of<kTurns>(louse, parameters_.thrust_max) : Drive{};
  }

  /// What a step's start is; a wall that the louse runs into throws it back before.
  Start begin(const Way& way) const {
    const double restitution = way.bounces < kMaxBounces ? parameters_.edge_restitution : 0.0;
    bool bounces = false;
    const Start start = ground_.template depart<kRules>(way.at, way.drive, rim_, restitution, bounces);
    if (bounces) {
      ++way.bounces;
      ++way.counters.bounces;
      way.happened |= state::kMetWall;
    }
    ++way.counters.samples;
    return start;
  }

  /// Whether a louse with that drive keeps its energy.
  [[nodiscard]] bool keeps_energy(const Drive& drive) const {
    return keeps_energy_ && !(drive.push > 0.0) && !(drive.along < 0.0);
  }
  /// Whether the ends of its steps are brought to it.
  [[nodiscard]] bool brings_to_energy(const Start& start, const Drive& drive) const {
    return kMayKeepEnergy && keeps_energy(drive) && !start.contact.any();
  }

  [[nodiscard]] double bearable_gain(double h) const {
    return rules_.template bearable_gain<I::kKeepsEnergy>(h);
  }

  /// The end of a sub-step with no more energy than it may have.
  [[nodiscard, gnu::noinline]] Motion bounded(const Start& start, const Drive& drive, const SubStep& step,
                                              const Motion& end) const {
    const double share = step.capped || brings_to_energy(start, drive) ? 0.0 : bearable_gain(step.h);
    return energy_bounded<F::central>(surface_, rim_, parameters_, start, drive, step.h, end,
                                      keeps_energy(drive), share);
  }

  const S& surface_;
  const state::Parameters& parameters_;
  Ground ground_;
  Rim rim_;
  double tick_;
  bool keeps_energy_;  ///< of who has no thrust
  SubStepRules rules_;
  bool unilateral_;
};

}  // namespace woodlouse::physics
