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
// Cell centres are the knots. A cell without data - the NODATA value, nan, inf, 1e30 and above - has no
// height; elevation/ground.h says what becomes of it.
#pragma once

#include <optional>
#include <string_view>

#include "shared/elevation/ground.h"
#include "shared/json/fields.h"

namespace woodlouse::map {

/// The grid as the file has it: lengths and heights in its units, the south row first. Nothing, and at least
/// one problem, when something is wrong: every fault of the header, of the heights the first.
std::optional<elevation::FileGrid> parse_esri_ascii_grid(std::string_view text, json::Problems& problems);

}  // namespace woodlouse::map
