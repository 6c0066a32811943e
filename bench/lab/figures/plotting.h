// Pieces of gnuplot scripts that several figures share.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/lab/figures/path.h"
#include "shared/document/surface_catalogue.h"

namespace woodlouse::lab {

/// A data block `name` ("$path"), a row for each of `rows`; an empty row is a blank line, which breaks lines.
std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows);

/// x y of each point, as rows of a block.
std::vector<std::vector<double>> plan_of(const std::vector<PathPoint>& path);
/// t and whatever `value` says.
std::vector<std::vector<double>> over_time(const std::vector<PathPoint>& path,
                                           const std::function<double(const PathPoint&)>& value);

/// Script that fills the block `name` with the surface's lines of equal height, `count` or so of them.
std::string height_lines(const std::string& name, const document::AnySurface& surface, std::size_t count);

/// Sets the plot of a part of the picture to a rectangle of it in pixels, (0, 0) at the lower left: so that
/// axes of equal range have equal scales, and an image's pixels fall on the picture's.
std::string place(double left, double bottom, double width, double height, double picture_width,
                  double picture_height);

}  // namespace woodlouse::lab
