#include "bench/lab/reference/motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::lab::reference {
namespace {

/// Slower than this [m/s] a louse that slows down has stopped, and sets off anew if it is not held.
constexpr Real kStandstill = 1e-9L;
/// More hops than that in one advance are shorter and shorter ones: a thrust drives on the ground alone, and
/// so may keep a louse at the verge of leaving it.
constexpr std::size_t kMostHops = 100;
constexpr std::size_t kMostSteps = 200000;
/// From rest the first moment is taken with an even acceleration [s].
constexpr Real kFirstMoment = 1e-10L;

}  // namespace

Motion::Motion(const terrain::Terrain& terrain, const state::Parameters& parameters,
               const state::Louse& start, const Care& care)
    : ground_(terrain), parameters_(parameters), care_(care) {
  assert(parameters.edges != state::Edges::kOpen);
  at_ = {start.position.x, start.position.y, start.velocity.x,
         start.velocity.y, start.heading.x,  start.heading.y};
  cell_ = ground_.cell_at(at_[kX], at_[kY]);
  thrust_ = thrust_of({start.thrust_kind, start.thrust}, {at_[kHx], at_[kHy]}, parameters_);
  flies_ = start.phase == state::Phase::kFlying;
  z_ = start.flight_z;
  climb_ = start.flight_vz;
}

void Motion::advance(Real seconds, const state::Thrust& thrust) {
  look_along_velocity();
  thrust_ = thrust_of(thrust, {at_[kHx], at_[kHy]}, parameters_);
  rests_ = false;
  Real remaining = seconds;
  const std::size_t hops_before = record_.take_offs, steps_before = record_.steps;
  while (remaining > 0 && !gave_up_) {
    gave_up_ = record_.take_offs - hops_before > kMostHops || record_.steps - steps_before > kMostSteps;
    if (flies_) {
      fly(remaining);
    } else if (!stand(remaining)) {
      slide(remaining);
    }
    if (rests_) break;
  }
  look_along_velocity();
}

/// Where no thrust turns the heading it is the velocity's direction.
void Motion::look_along_velocity() {
  const Real speed = std::hypot(at_[kVx], at_[kVy]);
  if ((thrust_.turns && !flies_) || !(speed > 0)) return;
  at_[kHx] = at_[kVx] / speed;
  at_[kHy] = at_[kVy] / speed;
}

/// On the walls that push now, of those that it touches without velocity along their normals.
void Motion::lean() {
  leans_ = {};
  if (parameters_.edges != state::Edges::kWalls) return;
  const terrain::Rectangle& walls = ground_.domain();
  const auto side = [](Real place, Real velocity, double low, double high) {
    return velocity != 0 ? 0 : place <= low ? -1 : place >= high ? 1 : 0;
  };
  const Touched touched{side(at_[kX], at_[kVx], walls.x_min, walls.x_max),
                        side(at_[kY], at_[kVy], walls.y_min, walls.y_max)};
  if (touched.x == 0 && touched.y == 0) return;
  leans_ = pushing_of(here(at_), position(), velocity(), thrust_at(at_), touched, parameters_);
}

Thrust Motion::thrust_at(const State& s) const {
  Thrust thrust = thrust_;
  if (thrust.turns) thrust.direction = {s[kHx], s[kHy]};
  return thrust;
}

Acting Motion::acting_at(const State& s) const {
  return acting(here(s), {s[kX], s[kY]}, {s[kVx], s[kVy]}, thrust_at(s), leans_, parameters_);
}

Pair Motion::leaning(const State& s) const {
  const Pair wall = acting_at(s).wall;
  return {-leans_.x * wall.x, -leans_.y * wall.y};
}

Motion::State Motion::slope(const State& s) const {
  const Pair a = acting_at(s).acceleration;
  State result{s[kVx], s[kVy], a.x, a.y, 0, 0};
  if (thrust_.turns) {
    const Real along = s[kHx] * s[kVx] + s[kHy] * s[kVy];
    result[kHx] = (s[kVx] - along * s[kHx]) / kHeadingLength;
    result[kHy] = (s[kVy] - along * s[kHy]) / kHeadingLength;
  }
  return result;
}

Motion::State Motion::stepped(Real h) const {
  return dop853_step(at_, h, [this](const State& s) { return slope(s); }).end;
}

/// Who has no speed, or all but none and slows down: whether it is held, or off it goes. False: it moves.
bool Motion::stand(Real& remaining) {
  const Real speed = speed_in_space(here(at_), velocity());
  if (speed > kStandstill) return false;
  if (speed > 0) {
    lean();
    const Pair a = acting_at(at_).acceleration;
    if (a.x * at_[kVx] + a.y * at_[kVy] >= 0 || !resists()) return false;
    remaining = std::max<Real>(0, remaining - std::hypot(at_[kVx], at_[kVy]) / std::hypot(a.x, a.y));
    look_along_velocity();
    at_[kVx] = at_[kVy] = 0;
  }
  lean();
  const Acting balance = acting_at(at_);
  if (holds(balance, thrust_, parameters_)) {
    record_.stops += speed > 0 ? 1 : 0;
    rests_ = true;
    return true;
  }
  if (!resists()) return false;  // nothing is singular there
  const Real hold = parameters_.friction * std::fabs(balance.normal) + thrust_.brake;
  const Real time = std::min(remaining, kFirstMoment);
  const Real share = (1 - hold / balance.pull) * time;
  at_[kVx] = share * balance.acceleration.x;
  at_[kVy] = share * balance.acceleration.y;
  at_[kX] += 0.5L * time * at_[kVx];
  at_[kY] += 0.5L * time * at_[kVy];
  remaining -= time;
  return true;
}

/// Whether something turns with the velocity, and can't be told at none.
bool Motion::resists() const { return parameters_.friction > 0.0 || thrust_.brake > 0; }

Real Motion::chosen_step(Real remaining) const {
  Real h = std::min(care_.longest, care_.adapts ? next_step_ : care_.longest);
  if (resists()) {
    // Resistance turns with the velocity: near a stop steps shrink with it.
    const Pair a = acting_at(at_).acceleration;
    const Real most = std::hypot(a.x, a.y);
    const Real speed = std::hypot(at_[kVx], at_[kVy]);
    if (h * most > 0.25L * speed) h = 0.25L * speed / most;
  }
  return std::min(h, remaining);
}

/// Shortens h until the error is small; what is due next is kept.
Real Motion::take_step(Real h, State& end) {
  for (;;) {
    const auto step = dop853_step(at_, h, [this](const State& s) { return slope(s); });
    ++record_.steps;
    end = step.end;
    if (!care_.adapts) return h;
    const Real ratio = step.error / care_.tolerance;
    const Real factor = ratio > 0 ? std::clamp(0.9L * std::pow(ratio, -0.125L), 0.2L, 4.0L) : 4.0L;
    if (ratio <= 1 || h < 1e-12L) {
      next_step_ = std::max(h * factor, 1e-9L);
      return h;
    }
    ++record_.refused;
    h *= std::min(factor, 0.9L);
  }
}

void Motion::slide(Real& remaining) {
  lean();
  if (parameters_.contact == state::SurfaceContact::kUnilateral && acting_at(at_).normal < 0)
    return meet(Event::kTakesOff);
  const Real wanted = chosen_step(remaining);
  const Real due = next_step_;
  State end;
  Real h = take_step(wanted, end);
  if (wanted < due) next_step_ = std::max(next_step_, due);  // it was short for another reason
  const Real whole = h;
  const Event event = first_event(h, end);
  remaining = h == remaining ? 0 : remaining - h;
  at_ = end;
  if (h < whole) next_step_ = std::max(next_step_, whole);
  if (leans_.x != 0) at_[kVx] = 0;
  if (leans_.y != 0) at_[kVy] = 0;
  if (thrust_.turns) {
    const Real size = std::hypot(at_[kHx], at_[kHy]);
    at_[kHx] /= size;
    at_[kHy] /= size;
  }
  meet(event);
}

}  // namespace woodlouse::lab::reference
