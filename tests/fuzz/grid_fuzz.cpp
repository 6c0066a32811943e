// Grid files: an ESRI ASCII grid, or the header of a float grid, reads back bit for bit once written anew, or
// is refused with a place.
//
// Input: a letter and the file's text: 'a' a whole ASCII grid, of which ground is made too, 'f' a float
// grid's header, 's' a Surfer grid of text, 'k' a file's first bytes, and its name.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "shared/elevation/file_kind.h"
#include "shared/elevation/ground.h"
#include "shared/elevation/hgt_grid_file.h"
#include "shared/elevation/surfer_ascii.h"
#include "shared/json/text.h"
#include "shared/map/esri_ascii_grid.h"
#include "shared/map/flt_grid_file.h"
#include "tests/fuzz/property.h"

using namespace woodlouse;
using fuzz::demand;
using fuzz::demand_readable;
using fuzz::same_bits;

namespace {

template <typename Grid>
std::string frame_text(const Grid& grid, std::string_view dx, std::string_view dy) {
  std::string out = "ncols " + std::to_string(grid.columns) + "\nnrows " + std::to_string(grid.rows);
  const auto append = [&out](std::string_view key, double value) {
    json::append_double(out.append("\n").append(key) += ' ', value);
  };
  append("xllcenter", grid.x_origin);
  append("yllcenter", grid.y_origin);
  append(dx, grid.dx);
  append(dy, grid.dy);
  return out + "\n";
}

template <typename Grid>
void check_same_frame(const Grid& a, const Grid& b) {
  demand(a.columns == b.columns && a.rows == b.rows, "the grid reads back in its size");
  demand(same_bits(a.dx, b.dx) && same_bits(a.dy, b.dy) && same_bits(a.x_origin, b.x_origin) &&
             same_bits(a.y_origin, b.y_origin),
         "the grid reads back in its place");
}

void check_ascii(std::string_view text) {
  json::Problems problems("grid.asc");
  const auto grid = map::parse_esri_ascii_grid(text, problems);
  demand(grid.has_value() == (problems.count() == 0), "a grid is refused for a reason");
  demand(problems.count() <= json::Problems::kMaxProblems, "the list of problems is bounded");
  for (const core::Error& error : problems.errors()) {
    demand(error.where.starts_with("grid.asc"), "an error names its place", error.where);
    demand_readable(error.text());
  }
  if (!grid) return;
  demand(grid->heights.size() == grid->columns * grid->rows, "a grid is whole");
  demand(std::none_of(grid->heights.begin(), grid->heights.end(),
                      [](double z) { return std::fabs(z) >= elevation::kNoHeightFrom; }),
         "heights are below what counts as none");
  std::string written = frame_text(*grid, "dx", "dy") + "NODATA_value nan\n";
  for (std::size_t row = grid->rows; row-- > 0;) {
    for (std::size_t column = 0; column < grid->columns; ++column) {
      const double height = grid->at(column, row);
      if (std::isfinite(height))
        json::append_double(written, height);
      else
        written += "nan";
      written += ' ';
    }
  }
  json::Problems none("written.asc");
  const auto again = map::parse_esri_ascii_grid(written, none);
  demand(again.has_value(), "what is written can be read",
         none.count() == 0 ? "" : none.errors().front().text());
  check_same_frame(*grid, *again);
  demand(std::equal(grid->heights.begin(), grid->heights.end(), again->heights.begin(), again->heights.end(),
                    same_bits),
         "the heights read back bit for bit");
}

void check_float_header(std::string_view text) {
  const auto header = map::parse_flt_header(text, "grid.hdr");
  if (!header) {
    demand(header.error().where.starts_with("grid.hdr"), "an error names its place", header.error().where);
    return demand_readable(header.error().text());
  }
  const terrain::GridFrame& frame = header->frame;
  demand(frame.columns >= 4 && frame.columns <= 1'000'000 && frame.rows >= 4 && frame.rows <= 1'000'000,
         "a float grid's size is in range");
  demand(frame.dx > 0.0 && frame.dy > 0.0, "knots are apart");
  std::string written = frame_text(frame, "xdim", "ydim");
  if (header->byte_order == map::ByteOrder::kBigEndian) written += "byteorder M\n";
  if (!std::isnan(header->no_data)) written += "nodata " + json::double_text(double{header->no_data}) + "\n";
  const auto again = map::parse_flt_header(written, "written.hdr");
  demand(again.has_value(), "what is written can be read", again ? "" : again.error().text());
  check_same_frame(frame, again->frame);
  demand(header->byte_order == again->byte_order, "the byte order reads back");
  demand(same_bits(double{header->no_data}, double{again->no_data}), "the mark of no data reads back");
}

void check_surfer(std::string_view text) {
  const auto grid = elevation::parse_surfer_ascii(text, "grid.grd", 4'000'000);
  if (!grid) {
    demand(grid.error().where.starts_with("grid.grd"), "an error names its place", grid.error().where);
    return demand_readable(grid.error().text());
  }
  demand(grid->heights.size() == grid->columns * grid->rows, "a grid is whole");
  demand(grid->dx > 0.0 && grid->dy > 0.0, "knots are apart");
}

/// Whatever ground comes of a grid is finite, and lies between the lowest and the highest of its data.
void check_ground(std::string_view text) {
  json::Problems problems("grid.asc");
  auto grid = map::parse_esri_ascii_grid(text, problems);
  if (!grid) return;
  double low = 1e300, high = -1e300;
  for (const double z : grid->heights) {
    if (!std::isfinite(z)) continue;
    low = std::fmin(low, z);
    high = std::fmax(high, z);
  }
  const auto ground = elevation::make_ground(std::move(*grid), {}, "grid.asc");
  if (!ground) return demand_readable(ground.error().text());
  if (!ground->note.empty()) demand_readable(ground->note);
  const double slack = 1e-3 * (high - low);
  for (const double z : ground->grid.heights)
    demand(z >= low - slack && z <= high + slack, "filled heights are within the shore's");
}

void check_first_bytes(std::string_view bytes) {
  if (const auto foreign = elevation::foreign_grid(bytes, "hill.asc")) demand_readable(foreign->text());
  static_cast<void>(elevation::corner_of_name(bytes));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'a') {
    check_ascii(text);
    check_ground(text);
  }
  if (data[0] == 's') check_surfer(text);
  if (data[0] == 'k') check_first_bytes(text);
  if (data[0] == 'f') check_float_header(text);
  return 0;
}
