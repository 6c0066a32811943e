// What is known of a big map without reading all of it: an overview of its heights, and a fingerprint that
// tells its file from others.
//
// Both come from the same rows, kOverviewSide of them at equal distances from the southern to the northern
// one (2.6 % of the heights of 10,001 rows): their heights go into the fingerprint whole, every
// columns/256-th into the overview. So a start costs 257 reads, not one of the whole file. A file that
// differs elsewhere alone passes for the same here; a recording's state hashes still tell, as soon as a louse
// comes near the difference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "shared/core/error.h"
#include "shared/elevation/ground.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::map {

inline constexpr std::size_t kOverviewSide = 257;  ///< knots each way at most

struct HeightSurvey {
  std::uint64_t fingerprint = 0;  ///< XXH64 of columns, rows, spacings and the surveyed rows' heights
  /// Over the whole domain, at most kOverviewSide knots each way; each has the height of the source's nearest
  /// knot, to 1/1024 m. Without data: filled (fill_missing.h), so a drawing has no holes.
  terrain::HeightGrid overview;
};

/// fill_level [m]: where there are no data near. `source` names it in errors: rows that can't be read, no
/// data at all where it was looked.
core::Expected<HeightSurvey> survey_heights(const terrain::HeightSource& heights, double fill_level,
                                            const std::string& source);

/// Knots of a grid: `columns` from `first_column` on, `rows` from `first_row` (0: the southern one) on.
struct Window {
  std::size_t first_column = 0;
  std::size_t first_row = 0;
  std::size_t columns = 0;
  std::size_t rows = 0;
};

/// The heights in a window, which lies in the grid; NaN where there are no data; the mark that was taken for
/// none. Errors as above.
core::Expected<elevation::FileGrid> read_heights(const terrain::HeightSource& heights, const Window& window,
                                                 const std::string& source);

/// The same of every height.
core::Expected<elevation::FileGrid> read_all_heights(const terrain::HeightSource& heights,
                                                     const std::string& source);

}  // namespace woodlouse::map
