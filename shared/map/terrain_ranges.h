// What a terrain's numbers may be, whichever way they come.
#pragma once

#include <cstddef>

#include "shared/json/fields.h"

namespace woodlouse::map {

inline constexpr json::Range kGridScale{1e-6, 1e6, ""};
inline constexpr json::Range kSpacing{1e-3, 1e6, "m"};
inline constexpr json::Range kOrigin{-1e7, 1e7, "m"};
inline constexpr json::Range kHeight{-1e6, 1e6, "m"};
/// 89.4 degrees between neighbouring knots. Steeper is a wall, and walls are the map's edge's business.
inline constexpr double kMaxSlope = 100.0;

inline constexpr std::size_t kMinKnotsEachWay = 4;

inline bool within(double value, const json::Range& range) {
  return value >= range.min && value <= range.max;
}

}  // namespace woodlouse::map
