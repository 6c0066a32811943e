// A part of an elevation file, asked for in the file's own coordinates, as ground.
#pragma once

#include <filesystem>
#include <vector>

#include "shared/core/error.h"
#include "shared/elevation/ground.h"

namespace woodlouse::server {

/// The knots of the file's grid that lie within `crop` (west, south, east, north, in the coordinates that its
/// header or name gives them, before the scale), as ground. Of a grid in degrees a metre is that of the
/// part's own latitude. Errors: the file can't be read; the part is turned round, reaches past the grid,
/// which tells where it lies, or leaves too few or too many knots.
core::Expected<elevation::Ground> cropped_ground(const std::filesystem::path& file,
                                                 const std::vector<double>& crop, double scale);

}  // namespace woodlouse::server
