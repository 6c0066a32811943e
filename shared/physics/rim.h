// The rim of the map, where lice are kept: four walls, or seams where the edges wrap and the map goes on at
// the opposite rim, or open edges, over which nobody comes back. Here is where it stands, when a louse meets
// it, and the state at that moment; what walls do to a louse: walls.h.
//
// An open edge ends a motion: who reaches it stands there, without velocity, for the rest of the tick, and so
// does in each tick who stands there and is drawn outwards. The rules of play may take it off the map.
//
// Positions on a map that wraps lie in [min, max): a louse that has run over a seam is moved by whole
// periods.
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>

#include "shared/core/root.h"
#include "shared/core/vec2.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/walls.h"
#include "shared/state/parameters.h"
#include "shared/terrain/surface.h"

namespace woodlouse::physics {

/// How many periods a louse was carried back by, per axis.
struct Turns {
  long long x = 0;
  long long y = 0;
  [[nodiscard]] constexpr bool any() const { return x != 0 || y != 0; }
};

class Rim {
 public:
  /// Walls: infinite sides keep nobody. Wrapping: the domain is one period; REQUIRES it finite.
  Rim(const terrain::Rectangle& domain, state::Edges edges)
      : domain_(domain),
        interior_(domain),
        walls_(domain),
        leant_on_(domain),
        tolerance_(1e-13 *
                   (finite_extent(domain.x_min, domain.x_max) + finite_extent(domain.y_min, domain.y_max))),
        edges_(edges) {
    if (edges == state::Edges::kWalls) return;
    constexpr double kNever = std::numeric_limits<double>::infinity();
    leant_on_ = {-kNever, -kNever, kNever, kNever};
    if (edges == state::Edges::kOpen) return;
    assert(domain.x_max - domain.x_min < kNever && domain.y_max - domain.y_min < kNever);
    interior_.x_max = before(domain.x_max);
    interior_.y_max = before(domain.y_max);
    walls_ = leant_on_;
  }

  [[nodiscard]] bool wraps() const { return edges_ == state::Edges::kWrap; }
  [[nodiscard]] bool is_open() const { return edges_ == state::Edges::kOpen; }
  /// The positions a louse may have.
  [[nodiscard]] const terrain::Rectangle& interior() const { return interior_; }
  /// How near to a wall is at the wall [m].
  [[nodiscard]] double tolerance() const { return tolerance_; }
  /// Whether neither a wall nor an open edge is met on the way to p.
  [[nodiscard]] bool lets_pass(core::Vec2 p) const { return walls_.contains(p.x, p.y); }
  /// Whether p is not beyond a seam.
  [[nodiscard]] bool is_here(core::Vec2 p) const { return !wraps() || interior_.contains(p.x, p.y); }
  /// The walls there; an open edge is none.
  [[nodiscard]] Contact touching(core::Vec2 p) const { return physics::touching(leant_on_, p); }
  /// Whether an open edge ends a motion there, at v and drawn by a.
  [[nodiscard]] bool lets_out(core::Vec2 p, core::Vec2 v, core::Vec2 a) const {
    if (!is_open()) return false;
    const auto [x, y] = physics::touching(walls_, p);
    return outward(x, v.x != 0.0 ? v.x : a.x) || outward(y, v.y != 0.0 ? v.y : a.y);
  }
  /// Whether p can be made a position again: within the walls, or not absurdly many periods away. False for
  /// NaN.
  [[nodiscard]] bool admits(core::Vec2 p) const {
    return wraps() ? turns_are_few(p.x, domain_.x_min, domain_.x_max) &&
                         turns_are_few(p.y, domain_.y_min, domain_.y_max)
                   : walls_.contains(p.x, p.y);
  }

  /// Moves p into the interior by whole periods. REQUIRES wraps(). What admits() refuses stays as it is.
  Turns carry_home(core::Vec2& p) const {
    if (interior_.contains(p.x, p.y) || !admits(p)) return {};
    return {carry(p.x, domain_.x_min, domain_.x_max), carry(p.y, domain_.y_min, domain_.y_max)};
  }

  /// p as a position: carried home, or the wall's nearest point where p lies beyond it.
  [[nodiscard]] core::Vec2 inside(core::Vec2 p) const {
    if (interior_.contains(p.x, p.y)) return p;
    if (!wraps()) return onto(p);
    carry_home(p);
    return p;
  }

  /// The same for where a louse stops or turns back: within rounding of a wall it has not left it.
  [[nodiscard]] core::Vec2 stopped(core::Vec2 p) const { return wraps() ? inside(p) : onto(p); }

  /// The time after which a motion that is at `end` after h, beyond a wall, meets it on its way out; `end`
  /// becomes the state there. again(t) is the motion after t instead: from where the cubic through both ends
  /// meets the wall, Newton's method inside a bracket repeats the sub-step, so that the state is the
  /// integrator's own. A wall that the louse slides along, or has just bounced off, is none that it meets,
  /// near as it is.
  template <typename Again>
  double reach(const Motion& start, double h, Motion& end, const Again& again) const {
    const Contact met = passed(end.position);
    double low = 0.0;
    double high = h;
    double t = time_on_cubic(start, end, h, met);
    if (t < h) end = again(t);
    for (int i = 0; i < 60; ++i) {
      const auto [distance, leaving] = beyond(end, met);
      if (distance >= -tolerance_ && distance <= tolerance_ && leaving > 0.0) break;
      (distance > tolerance_ || (distance > 0.0 && leaving > 0.0) ? high : low) = t;
      const double guess = leaving > 0.0 ? t - distance / leaving : low;
      t = guess > low && guess < high ? guess : 0.5 * (low + high);
      end = again(t);
    }
    end.position = onto(end.position);
    return t;
  }

  /// After what time a straight flight from p at v meets a wall, per axis; 1e300 or more: never.
  [[nodiscard]] core::Vec2 flight_times(core::Vec2 p, core::Vec2 v) const {
    return {flight_time(p.x, v.x, walls_.x_min, walls_.x_max),
            flight_time(p.y, v.y, walls_.y_min, walls_.y_max)};
  }
  /// The coordinates of the walls that a motion with velocity v runs towards.
  [[nodiscard]] core::Vec2 ahead(core::Vec2 v) const {
    return {v.x > 0.0 ? walls_.x_max : walls_.x_min, v.y > 0.0 ? walls_.y_max : walls_.y_min};
  }

 private:
  /// 0 where it has none.
  static double finite_extent(double low, double high) { return high - low < 1e300 ? high - low : 0.0; }

  /// The next smaller number.
  static double before(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    if (x == 0.0) return -std::numeric_limits<double>::denorm_min();
    return std::bit_cast<double>(x > 0.0 ? bits - 1 : bits + 1);
  }

  static bool turns_are_few(double p, double low, double high) {
    constexpr double kMost = 1e9;
    const double turns = (p - low) / (high - low);
    return turns > -kMost && turns < kMost;
  }

  static long long carry(double& p, double low, double high) {
    const double turns = (p - low) / (high - low);
    auto whole = static_cast<long long>(turns);
    if (static_cast<double>(whole) > turns) --whole;
    p -= static_cast<double>(whole) * (high - low);
    // Rounding can put what lies a hair beside a seam on its other side.
    if (p >= high) {
      ++whole;
      p = low;
    } else if (p < low) {
      p = low;
    }
    return whole;
  }

  /// The walls that p lies beyond, as touching() tells those it touches.
  [[nodiscard]] Contact passed(core::Vec2 p) const {
    return {p.x < walls_.x_min ? -1 : (p.x > walls_.x_max ? 1 : 0),
            p.y < walls_.y_min ? -1 : (p.y > walls_.y_max ? 1 : 0)};
  }

  struct Beyond {
    double distance;  ///< [m]; negative: inside
    double leaving;   ///< [m/s], outwards
  };

  /// Where a state is to the wall that it lies the furthest beyond, of those `met` and any that it is clearly
  /// beyond.
  [[nodiscard]] Beyond beyond(const Motion& s, Contact met) const {
    Beyond most{-std::numeric_limits<double>::infinity(), 0.0};
    const auto look = [&](bool counts, double distance, double leaving) {
      if ((counts || distance > tolerance_) && distance > most.distance) most = {distance, leaving};
    };
    look(met.x < 0, walls_.x_min - s.position.x, -s.velocity.x);
    look(met.x > 0, s.position.x - walls_.x_max, s.velocity.x);
    look(met.y < 0, walls_.y_min - s.position.y, -s.velocity.y);
    look(met.y > 0, s.position.y - walls_.y_max, s.velocity.y);
    return most;
  }

  /// When the cubic through both ends of a step over h meets the walls that `end` lies beyond; h where it
  /// does not tell.
  [[nodiscard]] double time_on_cubic(const Motion& start, const Motion& end, double h, Contact met) const {
    const auto inside = [&](double t) { return -beyond(on_cubic(start, end, h, t), met).distance; };
    const Beyond first = beyond(start, met);
    const double at_end = -beyond(end, met).distance;
    if (!(at_end < 0.0)) return h;
    if (first.distance < 0.0) return core::end_of_positive(0.0, -first.distance, h, at_end, inside);
    // It has just been thrown back by the wall: what is looked for is the second root.
    if (!(first.leaving < 0.0)) return h;
    return core::end_of_positive(0.0, -first.leaving, h, at_end / h, [&](double t) { return inside(t) / t; });
  }

  /// p, put onto the wall that it lies at but for rounding, or beyond.
  [[nodiscard]] core::Vec2 onto(core::Vec2 p) const {
    const double margin = 2.0 * tolerance_;
    if (p.x < walls_.x_min + margin) p.x = walls_.x_min;
    if (p.x > walls_.x_max - margin) p.x = walls_.x_max;
    if (p.y < walls_.y_min + margin) p.y = walls_.y_min;
    if (p.y > walls_.y_max - margin) p.y = walls_.y_max;
    return p;
  }

  /// Who is beyond a wall, as a state from outside may be by a little, meets it now.
  [[nodiscard]] static double flight_time(double at, double speed, double low, double high) {
    if (!(speed > 0.0) && !(speed < 0.0)) return 1e300;
    const double time = ((speed > 0.0 ? high : low) - at) / speed;
    return time > 0.0 ? time : 0.0;
  }

  terrain::Rectangle domain_;
  terrain::Rectangle interior_;  ///< what positions lie in
  terrain::Rectangle walls_;     ///< or open edges; infinite where the edges wrap
  terrain::Rectangle leant_on_;  ///< the walls; infinite where there are none
  double tolerance_;
  state::Edges edges_;
};

}  // namespace woodlouse::physics
