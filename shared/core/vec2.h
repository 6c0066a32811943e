// A pair: map-plane position [m], velocity [m/s], gradient [1], direction [1].
// Plain arithmetic only, in the order written: it is part of the simulation's bits.
#pragma once

#include "shared/core/exact_arithmetic.h"

namespace woodlouse::core {

/// T: double, or several doubles at once (lanes.h).
template <typename T>
struct Pair {
  T x{};
  T y{};

  friend constexpr bool operator==(const Pair&, const Pair&) = default;
  friend constexpr Pair operator+(Pair a, Pair b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Pair operator-(Pair a, Pair b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Pair operator-(Pair a) { return {-a.x, -a.y}; }
  friend constexpr Pair operator*(T s, Pair a) { return {s * a.x, s * a.y}; }
  friend constexpr Pair operator*(Pair a, T s) { return {a.x * s, a.y * s}; }
  constexpr Pair& operator+=(Pair b) { return *this = *this + b; }
};

template <typename T>
constexpr T dot(Pair<T> a, Pair<T> b) {
  return a.x * b.x + a.y * b.y;
}

/// Above 0 where b lies to the left of a.
template <typename T>
constexpr T cross(Pair<T> a, Pair<T> b) {
  return a.x * b.y - a.y * b.x;
}

using Vec2 = Pair<double>;

}  // namespace woodlouse::core
