#include "shared/rules/summits.h"

#include <algorithm>
#include <cstdint>
#include <variant>

#include "shared/map/canonical_map.h"
#include "shared/terrain/height_grid.h"

namespace woodlouse::rules {
namespace {

struct Knot {
  std::size_t i = 0, j = 0;
};

/// How many knots in a row lie nearer to the edge than the margin, where `cells` follow each other.
std::size_t knots_outside(double margin, double spacing, std::size_t cells) {
  std::size_t knots = 0;
  while (knots <= cells && static_cast<double>(knots) * spacing < margin) ++knots;
  return knots;
}

class Relief {
 public:
  Relief(const terrain::HeightGrid& grid, bool wraps, double margin) : grid_(grid), wraps_(wraps) {
    // Where it wraps, the last column and row are the first again.
    first_.i = wraps ? 0 : std::max<std::size_t>(1, knots_outside(margin, grid.dx, grid.columns));
    first_.j = wraps ? 0 : std::max<std::size_t>(1, knots_outside(margin, grid.dy, grid.rows));
    end_ = {wraps ? grid.columns - 1 : grid.columns - std::min(grid.columns, first_.i),
            wraps ? grid.rows - 1 : grid.rows - std::min(grid.rows, first_.j)};
  }

  [[nodiscard]] std::vector<Knot> summits() const {
    std::vector<Knot> found;
    for (std::size_t j = first_.j; j < end_.j; ++j) {
      for (std::size_t i = first_.i; i < end_.i; ++i) {
        if (is_summit(i, j)) found.push_back({i, j});
      }
    }
    return found;
  }

  /// Of the outermost ring within the margin.
  [[nodiscard]] std::vector<Knot> rim() const {
    if (wraps_ || first_.i + 1 >= end_.i || first_.j + 1 >= end_.j) return {};
    std::vector<Knot> ring;
    for (std::size_t i = first_.i; i + 1 < end_.i; ++i) ring.push_back({i, first_.j});
    for (std::size_t j = first_.j; j + 1 < end_.j; ++j) ring.push_back({end_.i - 1, j});
    for (std::size_t i = end_.i - 1; i > first_.i; --i) ring.push_back({i, end_.j - 1});
    for (std::size_t j = end_.j - 1; j > first_.j; --j) ring.push_back({first_.i, j});
    std::vector<Knot> found;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const double before = height(ring[(k + ring.size() - 1) % ring.size()]);
      const double behind = height(ring[(k + 1) % ring.size()]);
      if (height(ring[k]) > before && height(ring[k]) > behind) found.push_back(ring[k]);
    }
    return found;
  }

  [[nodiscard]] double height(Knot knot) const { return grid_.at(knot.i, knot.j); }

 private:
  [[nodiscard]] bool is_summit(std::size_t i, std::size_t j) const {
    const double own = grid_.at(i, j);
    const std::size_t columns = grid_.columns - 1, rows = grid_.rows - 1;
    const std::size_t west = i == 0 ? columns - 1 : i - 1, south = j == 0 ? rows - 1 : j - 1;
    const std::size_t east = wraps_ && i + 1 == columns ? 0 : i + 1;
    const std::size_t north = wraps_ && j + 1 == rows ? 0 : j + 1;
    for (const std::size_t y : {south, j, north}) {
      for (const std::size_t x : {west, i, east}) {
        if ((x != i || y != j) && !(grid_.at(x, y) < own)) return false;
      }
    }
    return true;
  }

  const terrain::HeightGrid& grid_;
  bool wraps_;
  Knot first_, end_;  ///< within the margin
};

}  // namespace

std::vector<core::Vec2> summits_of(const map::MapDefinition& map, double margin) {
  terrain::HeightGrid sampled;
  const auto* grid = std::get_if<terrain::HeightGrid>(&map.terrain);
  if (const auto* tiled = std::get_if<map::TiledTerrain>(&map.terrain)) grid = &tiled->overview;
  if (grid == nullptr) {
    sampled = map::knots_of(map);
    grid = &sampled;
  }
  const Relief relief(*grid, map.physics.edges == state::Edges::kWrap, margin);
  std::vector<Knot> knots = relief.summits();
  if (knots.empty()) knots = relief.rim();
  std::stable_sort(knots.begin(), knots.end(),
                   [&](Knot a, Knot b) { return relief.height(a) > relief.height(b); });
  if (knots.size() > kMaxSummits) knots.resize(kMaxSummits);
  std::vector<core::Vec2> places;
  for (const Knot knot : knots)
    places.push_back({grid->x_origin + static_cast<double>(knot.i) * grid->dx,
                      grid->y_origin + static_cast<double>(knot.j) * grid->dy});
  return places;
}

}  // namespace woodlouse::rules
