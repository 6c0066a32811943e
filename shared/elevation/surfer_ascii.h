// Surfer's grids of text (.grd that begins with DSAA).
//
//     DSAA
//     6 6            columns and rows
//     0 50           x of the first and the last column
//     0 50           y of the first (southern) and the last row
//     -5 5           the lowest and the highest height; not used
//     ...            rows * columns heights, the first row is the south; 1.70141e38: no data
#pragma once

#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/elevation/ground.h"

namespace woodlouse::elevation {

/// Whether a text begins as such a grid does.
bool is_surfer_ascii(std::string_view text);

/// The grid of a text. `source` names it in the error, with its line. Errors: a number missing, out of range
/// or too many; more than `most_knots`.
core::Expected<FileGrid> parse_surfer_ascii(std::string_view text, const std::string& source,
                                            std::size_t most_knots);

}  // namespace woodlouse::elevation
