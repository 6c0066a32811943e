// What a motion meets: the events of motion.h, and what each does to it.
#include <algorithm>
#include <cmath>

#include "bench/lab/reference/crossing.h"
#include "bench/lab/reference/motion.h"

namespace woodlouse::lab::reference {
namespace {

/// What comes back from a wall slower than that leans on it: its hop would be lost in the place's last
/// digits.
constexpr Real kLeans = 1e-7L;
/// A flight is at least that long [s]: time passes whatever rounding does.
constexpr Real kShortestHop = 1e-10L;

}  // namespace

template <typename Value>
Real Motion::located(Real h, const Value& value, State& end) const {
  return crossing(h, [&](Real t) {
    end = stepped(t);
    return value(end);
  });
}

Motion::Event Motion::first_event(Real& h, State& end) const {
  Event first = Event::kNone;
  const State whole = end;
  const State start = at_;
  Real soonest = h;
  const auto look = [&](Event event, const auto& value) {
    if (!(value(whole) < 0)) return;
    State there;
    const Real t = located(h, value, there);
    if (first != Event::kNone && t >= soonest) return;
    first = event;
    soonest = t;
    end = there;
  };
  // Who turns back on its way may have been beyond a line and home again: the step ends where it turns.
  const auto grazes = [&](std::size_t place, std::size_t velocity, Real low, Real high) {
    const Real change = start[velocity] - whole[velocity];
    if (!(start[velocity] * whole[velocity] < 0)) return false;
    const Real furthest = start[place] + 0.5L * h * start[velocity] * start[velocity] / change;
    const Real margin = 0.05L * h * std::fabs(start[velocity]);
    return furthest > high - margin || furthest < low + margin;
  };
  const auto turn = [&](std::size_t velocity) {
    look(Event::kTurnsBack,
         [&, sign = start[velocity] > 0 ? 1.0L : -1.0L](const State& s) { return sign * s[velocity]; });
  };
  if (leans_.x == 0) {
    look(Event::kLineX, [&](const State& s) { return std::min(s[kX] - cell_.x_min, cell_.x_max - s[kX]); });
    if (grazes(kX, kVx, cell_.x_min, cell_.x_max)) turn(kVx);
  } else {
    look(Event::kLeavesWallX, [&](const State& s) { return leaning(s).x; });
  }
  if (leans_.y == 0) {
    look(Event::kLineY, [&](const State& s) { return std::min(s[kY] - cell_.y_min, cell_.y_max - s[kY]); });
    if (grazes(kY, kVy, cell_.y_min, cell_.y_max)) turn(kVy);
  } else {
    look(Event::kLeavesWallY, [&](const State& s) { return leaning(s).y; });
  }
  if (parameters_.contact == state::SurfaceContact::kUnilateral)
    look(Event::kTakesOff, [&](const State& s) { return acting_at(s).normal; });
  if (parameters_.central_gravity > 0.0) {
    const auto beyond = [&](const State& s) { return std::hypot(s[kX], s[kY]) - parameters_.core_radius; };
    const Real side = beyond(start) != 0 ? beyond(start) : start[kX] * start[kVx] + start[kY] * start[kVy];
    look(Event::kCore, [&, sign = side > 0 ? 1.0L : -1.0L](const State& s) { return sign * beyond(s); });
  }
  h = soonest;
  return first;
}

void Motion::meet(Event event) {
  switch (event) {
    case Event::kLineX:
      return meet_line(true);
    case Event::kLineY:
      return meet_line(false);
    case Event::kTakesOff: {
      const Place place = here(at_);
      flies_ = true;
      z_ = place.z;
      climb_ = place.zx * at_[kVx] + place.zy * at_[kVy];
      ++record_.take_offs;
      return;
    }
    case Event::kCore:
      ++record_.core_rims;
      return;
    default:
      return;
  }
}

/// The louse stands on the nearer line of its cell, outward bound: a wall, a seam, or the next cell's.
void Motion::meet_line(bool along_x) {
  const std::size_t place = along_x ? kX : kY;
  Real& x = at_[place];
  const Real low = along_x ? cell_.x_min : cell_.y_min;
  const Real high = along_x ? cell_.x_max : cell_.y_max;
  const bool up = high - x < x - low;
  const terrain::Rectangle& domain = ground_.domain();
  const Real first = along_x ? domain.x_min : domain.y_min;
  const Real last = along_x ? domain.x_max : domain.y_max;
  x = up ? high : low;
  if (x > first && x < last) {
    ++record_.lines;
  } else if (parameters_.edges == state::Edges::kWrap) {
    ++record_.seams;
    x = up ? first : last;
  } else {
    ++record_.walls;
    if (!flies_) return bounce();
    Real& v = at_[along_x ? kVx : kVy];
    v *= -static_cast<Real>(parameters_.edge_restitution);
    return look_along_velocity();
  }
  const int by = up ? 1 : -1;
  cell_ = ground_.next(cell_, along_x ? by : 0, along_x ? 0 : by);
}

/// Off the walls that it runs into.
void Motion::bounce() {
  const Place place = here(at_);
  const terrain::Rectangle& walls = ground_.domain();
  const auto outward = [](Real x, Real v, double low, double high) {
    return (x <= low && v < 0) || (x >= high && v > 0);
  };
  const Real restitution = parameters_.edge_restitution;
  for (int impact = 0; impact < 100; ++impact) {  // between the two of a corner
    const bool on_x = outward(at_[kX], at_[kVx], walls.x_min, walls.x_max);
    const bool on_y = !on_x && outward(at_[kY], at_[kVy], walls.y_min, walls.y_max);
    if (!on_x && !on_y) return;
    const Real speed = std::fabs(on_x ? at_[kVx] : at_[kVy]);
    const Real kept = restitution * speed > kLeans ? restitution : 0;
    const auto thrown = [&](Pair u, Real e) {
      return on_x ? thrown_back_in_x(place, u, e) : thrown_back_in_y(place, u, e);
    };
    const Pair v = thrown({at_[kVx], at_[kVy]}, kept);
    at_[kVx] = on_x && kept == 0 ? 0 : v.x;
    at_[kVy] = on_y && kept == 0 ? 0 : v.y;
    if (!thrust_.turns) continue;
    const Pair h = thrown({at_[kHx], at_[kHy]}, kept);
    if (const Real size = std::hypot(h.x, h.y); size > 0) {
      at_[kHx] = h.x / size;
      at_[kHy] = h.y / size;
    }
  }
  at_[kVx] = at_[kVy] = 0;
}

/// On the parabola, a cell at a time.
void Motion::fly(Real& remaining) {
  const auto time_to = [](Real x, Real v, Real low, Real high) {
    return v > 0 ? (high - x) / v : v < 0 ? (low - x) / v : HUGE_VALL;
  };
  const Real to_x = time_to(at_[kX], at_[kVx], cell_.x_min, cell_.x_max);
  const Real to_y = time_to(at_[kY], at_[kVy], cell_.y_min, cell_.y_max);
  const Real g = parameters_.gravity;
  const Real whole = std::max<Real>(0, std::min({remaining, to_x, to_y}));
  const State start = at_;
  const auto clearance = [&](Real t) {
    return z_ + t * climb_ - 0.5L * g * t * t -
           ground_.at(cell_, start[kX] + t * start[kVx], start[kY] + t * start[kVy]).z;
  };
  // Part by part: what rises from the ground is above it first, and lands where it no longer is.
  constexpr int kParts = 64;
  Real landing = HUGE_VALL;
  for (int part = 1; part <= kParts && landing > whole && whole > 0; ++part) {
    const Real end = part == kParts ? whole : whole * part / kParts;
    if (clearance(end) < 0) {
      const Real begin = whole * (part - 1) / kParts;
      landing = begin + crossing(end - begin, [&](Real t) { return clearance(begin + t); });
      landing = std::max(landing, std::min(whole, kShortestHop));
    }
  }
  const Real time = std::min(landing, whole);
  at_[kX] += time * at_[kVx];
  at_[kY] += time * at_[kVy];
  z_ += time * climb_ - 0.5L * g * time * time;
  climb_ -= g * time;
  remaining = time == remaining ? 0 : remaining - time;
  if (landing <= whole) return land();
  if (time == to_x) {
    meet_line(true);
  } else if (time == to_y) {
    meet_line(false);
  }
}

/// The ground takes the velocity along its normal.
void Motion::land() {
  const Place place = here(at_);
  const Real size = 1 + place.zx * place.zx + place.zy * place.zy;
  const Real into = (climb_ - place.zx * at_[kVx] - place.zy * at_[kVy]) / size;
  at_[kVx] += into * place.zx;
  at_[kVy] += into * place.zy;
  flies_ = false;
  ++record_.landings;
  if (thrust_.turns) {
    const Real speed = std::hypot(at_[kVx], at_[kVy]);
    if (speed > 0) {
      at_[kHx] = at_[kVx] / speed;
      at_[kHy] = at_[kVy] / speed;
    }
  }
}

}  // namespace woodlouse::lab::reference
