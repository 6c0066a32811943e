#include "shared/map/opened_grid.h"

#include <utility>

#include "shared/elevation/file_kind.h"
#include "shared/elevation/surfer_ascii.h"
#include "shared/map/esri_ascii_grid.h"
#include "shared/map/float_grid_reader.h"
#include "shared/map/map_text.h"

namespace woodlouse::map {
namespace {

/// A text's grid in memory, with the mark that was taken for no data.
class TextHeights final : public terrain::HeightSource {
 public:
  explicit TextHeights(elevation::FileGrid grid) : mark_(grid.undeclared_mark), heights_(std::move(grid)) {}
  [[nodiscard]] terrain::GridFrame frame() const override { return heights_.frame(); }
  void read(std::size_t column, std::size_t row, std::span<double> out) const override {
    heights_.read(column, row, out);
  }
  [[nodiscard]] std::optional<double> undeclared_mark() const override { return mark_; }

 private:
  std::optional<double> mark_;
  terrain::GridHeights heights_;
};

core::Expected<OpenedGrid> opened(const core::Expected<std::string>& text, const std::string& path) {
  if (!text) return tl::unexpected(text.error());
  json::Problems problems(path);
  auto grid = parse_grid_text(*text, path, problems);
  if (!grid) return tl::unexpected(problems.errors().front());
  const terrain::GridFrame frame{grid->columns,  grid->rows, grid->x_origin,
                                 grid->y_origin, grid->dx,   grid->dy};
  const bool is_in_degrees = elevation::looks_like_degrees(frame, elevation::steepest_step(*grid));
  return OpenedGrid{std::make_shared<TextHeights>(std::move(*grid)), is_in_degrees};
}

}  // namespace

std::optional<elevation::FileGrid> parse_grid_text(const std::string& text, const std::string& path,
                                                   json::Problems& problems) {
  if (auto foreign = elevation::foreign_grid(text, path)) {
    problems.add(std::move(*foreign));
    return std::nullopt;
  }
  if (elevation::is_surfer_ascii(text)) {
    auto grid = elevation::parse_surfer_ascii(text, path, kMaxKnots);
    if (grid) return std::move(*grid);
    problems.add(std::move(grid.error()));
    return std::nullopt;
  }
  json::Problems grid_problems(path);
  std::optional<elevation::FileGrid> grid = parse_esri_ascii_grid(text, grid_problems);
  problems.take_over(std::move(grid_problems));
  return grid;
}

core::Expected<OpenedGrid> open_grid(const GridFolder& folder, const std::string& name) {
  const auto path = folder.find(name);
  if (!path) return tl::unexpected(path.error());
  const bool is_tile = is_srtm_tile(*path);
  if (!is_tile && !is_float_grid(*path)) return opened(folder.read_text(*path), *path);
  auto heights = folder.open_heights(*path, std::nullopt);
  if (!heights) return tl::unexpected(heights.error());
  const bool is_in_degrees = is_tile || is_in_degrees_by_looks(**heights);
  return OpenedGrid{std::move(*heights), is_in_degrees};
}

}  // namespace woodlouse::map
