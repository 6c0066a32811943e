// The summits of a map, where what is worth more lies.
#pragma once

#include <cstddef>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/map/map_definition.h"

namespace woodlouse::rules {

inline constexpr std::size_t kMaxSummits = 64;

/// The knots that are higher than all eight around them, `margin` [m] or more from the map's edge, the
/// highest first, at most kMaxSummits [m]; of a map in tiles the overview's, of a function those it is drawn
/// from. Where the edges wrap they go on over the seam, and there is no margin. A map that has none, as a
/// bowl has: of the outermost ring of knots within the margin, those higher than both beside them; a level or
/// wrapping map may have none at all.
std::vector<core::Vec2> summits_of(const map::MapDefinition& map, double margin);

}  // namespace woodlouse::rules
