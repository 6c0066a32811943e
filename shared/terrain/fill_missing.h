// Heights for knots that have none, so that a spline can be laid through the rest.
//
// In kFillReach rounds every missing knot that touches a known one (eight neighbours) takes the mean of those
// it touches; what is missing still takes `level`. A filled height depends on the heights within kFillReach
// knots alone, so that overlapping windows agree on it, and at the shore of a hole the step to `level` is
// felt with a factor of 0.268^kFillReach = 7e-10.
#pragma once

#include <cstddef>
#include <vector>

namespace woodlouse::terrain {

inline constexpr std::size_t kFillReach = 16;  ///< [knots]

/// Fills every non-finite height of `columns` heights a row. O(kFillReach heights) at worst.
void fill_missing(std::vector<double>& heights, std::size_t columns, double level);

}  // namespace woodlouse::terrain
