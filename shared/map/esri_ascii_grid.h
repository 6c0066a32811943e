// ESRI ASCII grids (.asc): heights as text, what `gdal_translate -of AAIGrid` writes.
//
//     ncols 87                      header keys in any case and order
//     nrows 61
//     xllcenter 0.0                 or xllcorner, half a cell further west; yllcenter, yllcorner alike
//     yllcenter 0.0
//     cellsize 10.0                 or dx and dy
//     NODATA_value -9999            may be left out
//     103 104 104 ...               nrows * ncols heights, row 1 is the north; line breaks mean nothing
//
// Cell centres are the knots. A cell without data is an error: there is nothing to stand on.
#pragma once

#include <optional>
#include <string_view>

#include "shared/json/fields.h"
#include "shared/terrain/height_grid.h"

namespace woodlouse::map {

/// The grid as the file has it: lengths and heights in its units, the south row first. Nothing, and at least
/// one problem, when something is wrong.
std::optional<terrain::HeightGrid> parse_esri_ascii_grid(std::string_view text, json::Problems& problems);

}  // namespace woodlouse::map
