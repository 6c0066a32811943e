// A thrust and how it is rounded: the value that the wire brings, a louse keeps and a recording names.
#pragma once

#include <cstdint>
#include <limits>

#include "shared/core/vec2.h"

namespace woodlouse::state {

/// How `Thrust::value` is meant.
enum class ThrustKind : std::uint32_t {
  kNone = 0,          ///< no thrust
  kAlongHeading = 1,  ///< value.x in [-1, 1]: the document's pulse; positive drives along the heading,
                      ///< negative brakes
  kMapVector = 2,     ///< value of length <= 1: pushes along the tangent over it, in space by its length
};

/// Ticks of a thrust that holds until the next one.
inline constexpr std::uint32_t kHeld = std::numeric_limits<std::uint32_t>::max();

/// What every component of a thrust that came from outside is a multiple of. A power of two: multiplying by
/// it is exact.
inline constexpr double kThrustQuantum = 1.0 / 128.0;

/// A thrust; 1 is the map's thrust_max.
struct Thrust {
  ThrustKind kind = ThrustKind::kNone;
  core::Vec2 value;
  friend bool operator==(const Thrust&, const Thrust&) = default;
};

struct RoundedThrust {
  Thrust thrust;
  bool clamped = false;  ///< it was out of range by more than rounding
};

/// Of any finite number: clamped to [-1, 1], rounded to the nearest quantum. What rounds to the end of the
/// range counts as within it.
RoundedThrust rounded_along_heading(double value);
/// Of any finite pair: cut to length 1, rounded to the nearest quanta; at the rim, where that would lengthen
/// it past 1, towards zero.
RoundedThrust rounded_map_vector(core::Vec2 value);

/// The quanta next to it towards zero, so that no vector gets longer. A component may become minus zero.
core::Vec2 quanta_towards_zero(core::Vec2 value);

}  // namespace woodlouse::state
