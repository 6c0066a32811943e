#include "shared/terrain/harmonic_fill.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace woodlouse::terrain {
namespace {

constexpr int kCycles = 16;
constexpr int kVisits = 2;           ///< of the next coarser level, each time
constexpr int kSweeps = 2;           ///< each way, on each level
constexpr int kCoarsestSweeps = 24;  ///< where nothing coarser is left

struct Weights {
  double east;   ///< of the neighbours in east and west
  double north;  ///< of those in north and south
};

/// One grid of the hierarchy: solves A z = right at the missing knots; known ones have their value.
struct Level {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<double> z;
  std::vector<double> right;
  std::vector<std::uint8_t> missing;

  [[nodiscard]] std::size_t size() const { return columns * rows; }
};

/// What the neighbours of a knot say: the sum of their weighted heights, and of their weights.
struct Around {
  double sum = 0.0;
  double weight = 0.0;
};

Around around(const Level& level, Weights w, std::size_t i, std::size_t j) {
  const std::size_t k = j * level.columns + i;
  Around result;
  const auto add = [&](std::size_t neighbour, double weight) {
    result.sum += weight * level.z[neighbour];
    result.weight += weight;
  };
  if (i > 0) add(k - 1, w.east);
  if (i + 1 < level.columns) add(k + 1, w.east);
  if (j > 0) add(k - level.columns, w.north);
  if (j + 1 < level.rows) add(k + level.columns, w.north);
  return result;
}

/// A Gauss-Seidel sweep; `forward` from the south-west on, else back, so that a cycle prefers no direction.
void sweep(Level& level, Weights w, bool forward) {
  for (std::size_t n = 0; n < level.size(); ++n) {
    const std::size_t k = forward ? n : level.size() - 1 - n;
    if (level.missing[k] == 0) continue;
    const Around neighbours = around(level, w, k % level.columns, k / level.columns);
    if (neighbours.weight > 0.0) level.z[k] = (level.right[k] + neighbours.sum) / neighbours.weight;
  }
}

/// A fine knot's place between coarse ones along one axis: itself, or halfway to the next.
struct Parents {
  std::size_t first;
  std::size_t second;
};

Parents parents(std::size_t fine, std::size_t coarse_count) {
  const std::size_t first = fine / 2;
  return {first, fine % 2 == 0 ? first : std::min(first + 1, coarse_count - 1)};
}

/// visit(fine knot, its four coarse ones, a quarter each) for each missing fine knot.
template <typename Visit>
void each_missing(const Level& fine, const Level& coarse, const Visit& visit) {
  for (std::size_t j = 0; j < fine.rows; ++j) {
    const Parents rows = parents(j, coarse.rows);
    for (std::size_t i = 0; i < fine.columns; ++i) {
      const std::size_t k = j * fine.columns + i;
      if (fine.missing[k] == 0) continue;
      const Parents columns = parents(i, coarse.columns);
      const std::size_t south = rows.first * coarse.columns;
      const std::size_t north = rows.second * coarse.columns;
      visit(k, std::array{south + columns.first, south + columns.second, north + columns.first,
                          north + columns.second});
    }
  }
}

/// Whether every fine knot that a coarse one's correction reaches is missing.
bool is_inside(const Level& fine, std::size_t column, std::size_t row) {
  const std::size_t last_row = std::min(2 * row + 2, fine.rows);
  const std::size_t last_column = std::min(2 * column + 2, fine.columns);
  for (std::size_t j = row == 0 ? 0 : 2 * row - 1; j < last_row; ++j) {
    for (std::size_t i = column == 0 ? 0 : 2 * column - 1; i < last_column; ++i) {
      if (fine.missing[j * fine.columns + i] == 0) return false;
    }
  }
  return true;
}

Level coarser(const Level& fine) {
  Level coarse;
  coarse.columns = (fine.columns + 1) / 2;
  coarse.rows = (fine.rows + 1) / 2;
  coarse.z.assign(coarse.size(), 0.0);
  coarse.right.assign(coarse.size(), 0.0);
  coarse.missing.assign(coarse.size(), 0);
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    coarse.missing[k] = is_inside(fine, k % coarse.columns, k / coarse.columns) ? 1 : 0;
  }
  return coarse;
}

bool has_missing(const Level& level) {
  return std::any_of(level.missing.begin(), level.missing.end(), [](std::uint8_t m) { return m != 0; });
}

/// The residual of the fine level, as the coarse one's right side; its correction begins at 0.
void restrict_residual(const Level& fine, Level& coarse, Weights w) {
  std::fill(coarse.z.begin(), coarse.z.end(), 0.0);
  std::fill(coarse.right.begin(), coarse.right.end(), 0.0);
  each_missing(fine, coarse, [&](std::size_t k, const std::array<std::size_t, 4>& above) {
    const Around neighbours = around(fine, w, k % fine.columns, k / fine.columns);
    const double residual = fine.right[k] + neighbours.sum - neighbours.weight * fine.z[k];
    for (const std::size_t parent : above) {
      if (coarse.missing[parent] != 0) coarse.right[parent] += 0.25 * residual;
    }
  });
}

void add_correction(const Level& coarse, Level& fine) {
  each_missing(fine, coarse, [&](std::size_t k, const std::array<std::size_t, 4>& above) {
    for (const std::size_t parent : above) fine.z[k] += 0.25 * coarse.z[parent];
  });
}

void cycle(std::vector<Level>& levels, std::size_t index, Weights w) {
  Level& level = levels[index];
  const bool is_coarsest = index + 1 == levels.size();
  const int sweeps = is_coarsest ? kCoarsestSweeps : kSweeps;
  for (int n = 0; n < sweeps; ++n) sweep(level, w, true);
  if (!is_coarsest) {
    restrict_residual(level, levels[index + 1], w);
    for (int n = 0; n < kVisits; ++n) cycle(levels, index + 1, w);
    add_correction(levels[index + 1], level);
  }
  for (int n = 0; n < sweeps; ++n) sweep(level, w, false);
}

/// A first guess: what is missing takes the mean of the block of 2 x 2, 4 x 4, ... knots around it that first
/// has a known one.
void guess(std::vector<double>& heights, std::size_t columns) {
  const std::size_t rows = heights.size() / columns;
  if (std::all_of(heights.begin(), heights.end(), [](double z) { return std::isfinite(z); })) return;
  const std::size_t coarse_columns = (columns + 1) / 2;
  std::vector<double> sums(coarse_columns * ((rows + 1) / 2), 0.0);
  std::vector<double> counts(sums.size(), 0.0);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const std::size_t parent = k / columns / 2 * coarse_columns + k % columns / 2;
    if (!std::isfinite(heights[k])) continue;
    sums[parent] += heights[k];
    counts[parent] += 1.0;
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= counts[k];  // NaN where nothing is known
  guess(sums, coarse_columns);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (!std::isfinite(heights[k])) heights[k] = sums[k / columns / 2 * coarse_columns + k % columns / 2];
  }
}

}  // namespace

void fill_harmonically(std::vector<double>& heights, std::size_t columns, double dx, double dy) {
  assert(columns > 0 && heights.size() % columns == 0 && dx > 0.0 && dy > 0.0);
  assert(std::any_of(heights.begin(), heights.end(), [](double z) { return std::isfinite(z); }));
  Level finest;
  finest.columns = columns;
  finest.rows = heights.size() / columns;
  finest.missing.reserve(heights.size());
  for (const double height : heights) finest.missing.push_back(std::isfinite(height) ? 0 : 1);
  if (!has_missing(finest)) return;
  finest.z = std::move(heights);
  guess(finest.z, columns);
  finest.right.assign(finest.size(), 0.0);
  std::vector<Level> levels;
  levels.push_back(std::move(finest));
  while (std::max(levels.back().columns, levels.back().rows) > 3) {
    Level next = coarser(levels.back());
    if (!has_missing(next)) break;
    levels.push_back(std::move(next));
  }
  const Weights weights{1.0, (dx / dy) * (dx / dy)};
  for (int n = 0; n < kCycles; ++n) cycle(levels, 0, weights);
  heights = std::move(levels.front().z);
}

}  // namespace woodlouse::terrain
