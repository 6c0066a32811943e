// What a map's ground is like, in figures, for who makes one.
#pragma once

#include <string>
#include <vector>

#include "shared/map/map_definition.h"

namespace woodlouse::server {

/// One line a figure: size, relief, steepest slope, largest curvature, sub-steps and cost of a louse's step,
/// and how far the surface overshoots its knots. A big map's are of its overview, which they say. REQUIRES a
/// map in full detail. Takes some tenths of a second.
std::vector<std::string> summary_of(const map::Map& map);

}  // namespace woodlouse::server
