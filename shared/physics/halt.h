// How a louse sets off, slows down and stops, where forces turn with its velocity (friction, a drive along
// the heading), or where an open edge ends its motion. Start, Ground: ground.h. Way: stepper.h.
//
// Stop: where friction can hold at v = 0 (the stick test) and |v| + h at <= 0, or v is too small for the
// shortest sub-step to resolve its direction, the louse halts after |v|/(-at), at = d|v|3/dt. Where it can't
// hold, it slows, turns and goes on; only when v and a are exactly opposite is v = 0 passed, by splitting the
// sub-step there.
//
// + - * / and sqrt only, in the order written: these are the simulation's bits.
#pragma once

#include <cmath>

#include "shared/physics/ground.h"
#include "shared/physics/rim.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/surface_motion.h"
#include "shared/state/louse.h"
#include "shared/state/step_events.h"

namespace woodlouse::physics {

/// What a sub-step comes to before its end.
enum class Halt { kNo, kRests, kTurnsBack };

template <typename Start>
[[gnu::always_inline]] inline bool is_held(const Start& start, const RestingBalance& b) {
  return squared_length_in_space(start.sample, b.pull) <= b.hold * b.hold;
}

/// Whether a louse that stands there is held.
template <typename Ground>
[[nodiscard]] bool holds_at(const Ground& ground, const Rim& rim, core::Vec2 place, const Drive& drive) {
  typename Ground::Start start;
  start.at = {place, {}};
  start.sample = ground.site(place);
  start.contact = rim.touching(place);
  return is_held(start, ground.balance(start, drive));
}

/// Where a louse halts that slows down evenly over `half` seconds twice; where it stands, if what it has and
/// what `push` gives it on the way does not lead that high.
template <typename Ground>
[[nodiscard]] core::Vec2 halting_place(const Ground& ground, const Rim& rim,
                                       const typename Ground::Start& start, double half, double push) {
  const core::Vec2 from = start.at.position;
  const core::Vec2 place = rim.stopped(from + half * start.at.velocity);
  const double climbed =
      ground.potential_at(place, ground.site(place)) - ground.potential_at(from, start.sample);
  return climbed <= 0.5 * start.speed2 + push * half * std::sqrt(start.speed2) ? place : rim.stopped(from);
}

/// At v = 0: the acceleration out of rest, friction opposing the motion about to begin. False: it is held.
template <typename Ground>
bool set_off(const Ground& ground, typename Ground::Start& start, const Drive& drive) {
  const RestingBalance b = ground.balance(start, drive);
  if (is_held(start, b)) return false;
  const double pull = std::sqrt(squared_length_in_space(start.sample, b.pull));
  start.acceleration = (1.0 - b.hold / pull) * b.pull;
  return true;
}

/// Whether v's direction may turn too far within h [s].
template <typename Start>
[[gnu::always_inline]] inline bool turns_too_far(const SubStepRules& rules, const Start& start,
                                                 const Drive& drive, double h) {
  const double a2 = squared_length_in_space(start.sample, start.acceleration);
  return SubStepRules::turns_too_far(a2 + rules.stiffness2(drive.along), start.speed2, h);
}

/// d|v|3/dt at the start [m/s^2]; REQUIRES speed > 0.
template <typename Start>
double speed_rate(const Start& start, double speed) {
  const auto& s = start.sample;
  const core::Vec2 v = start.at.velocity;
  const core::Vec2 a = start.acceleration;
  const double vz = s.zx * v.x + s.zy * v.y;
  return (dot(v, a) + vz * (s.zx * a.x + s.zy * a.y + curvature_along(s, v))) / speed;
}

/// A sub-step within which v would have turned too far.
struct Turning {
  double speed;   ///< |v|3 at its start [m/s], > 0
  double rate;    ///< speed_rate() [m/s^2]
  double h;       ///< shortened [s]
  bool resolved;  ///< v's direction can be trusted now; false: it is the shortest there is
};

/// Halves h [s] until v's direction can be trusted, or the shortest sub-step is reached; speeding up, only
/// what acts across v swings it. A push that does not end in a stop may lead a little astray.
template <typename Start>
Turning limit_turn(const SubStepRules& rules, const Start& start, const Drive& drive, double speed,
                   double h) {
  const double rate = speed_rate(start, speed);
  double a2 = squared_length_in_space(start.sample, start.acceleration) + rules.stiffness2(drive.along);
  if (rate > 0.0) a2 -= rate * rate;
  const auto turns = [&] {
    return SubStepRules::turns_too_far(a2, start.speed2, h) &&
           (!(drive.push > 0.0) || !(speed + h * rate > 0.0) || rules.strays_too_far(a2, start.speed2, h));
  };
  while (h > rules.shortest() && turns()) h = rules.halved(h);
  return {speed, rate, h, !turns()};
}

/// A louse that is slower than can be resolved, and can be held, is at its end; a fast one whose friction
/// turns with the ground's curvature is not, and friction that holds at v = 0 tells it apart: by itself it
/// makes |a| at most twice itself.
template <typename Ground>
Halt halts(const Ground& ground, const typename Ground::Start& start, const Turning& turning,
           const Drive& drive) {
  const auto [speed, rate, h, resolved] = turning;
  const bool stops = !(speed + h * rate > 0.0);
  if (!stops && resolved) return Halt::kNo;
  const RestingBalance balance = ground.balance(start, drive);
  if (!stops && speed > 20.0 * h * balance.hold) return Halt::kNo;
  if (is_held(start, balance)) return Halt::kRests;
  if (!stops) return Halt::kNo;
  const double a2 = squared_length_in_space(start.sample, start.acceleration);
  return a2 - rate * rate <= 1e-12 * a2 ? Halt::kTurnsBack : Halt::kNo;
}

/// It rests where it is.
template <typename Way>
void rest(const Way& way) {
  way.louse.phase = state::Phase::kResting;
  way.happened |= state::kStopped;
}

/// It stands where it is, at an open edge, for the rest of the tick. True: it does not rest.
template <typename Way>
[[gnu::noinline]] bool leave(const Way& way) {
  if (!way.drive.turns && dot(way.at.velocity, way.at.velocity) > kStandstill2)
    way.louse.heading = unit(way.at.velocity);
  way.at.velocity = {};
  way.louse.flight_vz = 0.0;
  way.remaining = 0.0;
  way.happened |= state::kLeft;
  return true;
}

}  // namespace woodlouse::physics
