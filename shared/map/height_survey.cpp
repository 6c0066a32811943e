#include "shared/map/height_survey.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "shared/core/stable_hash.h"
#include "shared/terrain/fill_missing.h"

namespace woodlouse::map {
namespace {

constexpr double kOverviewStep = 1.0 / 1024.0;  // [m]; digits nobody sees cost bytes on the wire

/// The k-th of `count` knots at equal distances among `knots`, the nearest there is.
std::size_t surveyed(std::size_t k, std::size_t count, std::size_t knots) {
  return (k * (knots - 1) + (count - 1) / 2) / (count - 1);
}

core::Expected<void> check_read(const terrain::HeightSource& heights, const std::vector<double>& found,
                                const std::string& source) {
  if (heights.read_failures() != 0) {
    return core::fail(source, "can't be read to its end",
                      "check the disk, and that nobody is writing the file");
  }
  if (std::none_of(found.begin(), found.end(), [](double z) { return std::isfinite(z); })) {
    return core::fail(source, "has no heights, only knots without data",
                      "check NODATA_value and byteorder in its header, and that heights stay within 1000 km");
  }
  return {};
}

}  // namespace

core::Expected<HeightSurvey> survey_heights(const terrain::HeightSource& heights, double fill_level,
                                            const std::string& source) {
  const terrain::GridFrame frame = heights.frame();
  HeightSurvey survey;
  terrain::HeightGrid& grid = survey.overview;
  grid.columns = std::min(frame.columns, kOverviewSide);
  grid.rows = std::min(frame.rows, kOverviewSide);
  grid.x_origin = frame.x_origin;
  grid.y_origin = frame.y_origin;
  grid.dx = frame.dx * static_cast<double>(frame.columns - 1) / static_cast<double>(grid.columns - 1);
  grid.dy = frame.dy * static_cast<double>(frame.rows - 1) / static_cast<double>(grid.rows - 1);
  core::StableHasher hasher;
  hasher.append(static_cast<std::uint64_t>(frame.columns));
  hasher.append(static_cast<std::uint64_t>(frame.rows));
  hasher.append(frame.dx);
  hasher.append(frame.dy);
  std::vector<double> row(frame.columns);
  grid.heights.reserve(grid.columns * grid.rows);
  for (std::size_t j = 0; j < grid.rows; ++j) {
    heights.read(0, surveyed(j, grid.rows, frame.rows), row);
    hasher.append(std::span<const double>(row));
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const double height = row[surveyed(i, grid.columns, frame.columns)];
      grid.heights.push_back(std::round(height / kOverviewStep) * kOverviewStep);
    }
  }
  survey.fingerprint = hasher.value();
  if (auto read = check_read(heights, grid.heights, source); !read) return tl::unexpected(read.error());
  terrain::fill_missing(grid.heights, grid.columns, fill_level);
  return survey;
}

core::Expected<elevation::FileGrid> read_heights(const terrain::HeightSource& heights, const Window& window,
                                                 const std::string& source) {
  const terrain::GridFrame frame = heights.frame();
  elevation::FileGrid grid;
  static_cast<terrain::HeightGrid&>(grid) = {
      window.columns,
      window.rows,
      frame.x_origin + static_cast<double>(window.first_column) * frame.dx,
      frame.y_origin + static_cast<double>(window.first_row) * frame.dy,
      frame.dx,
      frame.dy,
      {}};
  grid.heights.resize(window.columns * window.rows);
  for (std::size_t j = 0; j < window.rows; ++j) {
    heights.read(window.first_column, window.first_row + j,
                 std::span(grid.heights).subspan(j * window.columns, window.columns));
  }
  if (auto read = check_read(heights, grid.heights, source); !read) return tl::unexpected(read.error());
  grid.undeclared_mark = heights.undeclared_mark();
  return grid;
}

core::Expected<elevation::FileGrid> read_all_heights(const terrain::HeightSource& heights,
                                                     const std::string& source) {
  const terrain::GridFrame frame = heights.frame();
  return read_heights(heights, {0, 0, frame.columns, frame.rows}, source);
}

}  // namespace woodlouse::map
