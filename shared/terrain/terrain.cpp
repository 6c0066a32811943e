#include "shared/terrain/terrain.h"

#include <cassert>
#include <utility>

namespace woodlouse::terrain {

Terrain::Terrain(Alternatives surface)
    : surface_(std::move(surface)), domain_(std::visit([](const auto& s) { return s.domain(); }, surface_)) {}

SurfaceSample Terrain::sample(double x, double y) const {
  assert(domain_.contains(x, y));
  return std::visit([&](const auto& s) { return SurfaceSample{s.sample(x, y)}; }, surface_);
}

HeightGrid sample_grid(const Terrain& terrain, std::size_t columns, std::size_t rows) {
  assert(columns >= 2 && rows >= 2);
  const Rectangle domain = terrain.domain();
  HeightGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.x_origin = domain.x_min;
  grid.y_origin = domain.y_min;
  grid.dx = (domain.x_max - domain.x_min) / static_cast<double>(columns - 1);
  grid.dy = (domain.y_max - domain.y_min) / static_cast<double>(rows - 1);
  grid.heights.reserve(columns * rows);
  for (std::size_t j = 0; j < rows; ++j) {
    const double y = j + 1 == rows ? domain.y_max : domain.y_min + static_cast<double>(j) * grid.dy;
    for (std::size_t i = 0; i < columns; ++i) {
      const double x = i + 1 == columns ? domain.x_max : domain.x_min + static_cast<double>(i) * grid.dx;
      grid.heights.push_back(terrain.sample(x, y).z);
    }
  }
  return grid;
}

}  // namespace woodlouse::terrain
