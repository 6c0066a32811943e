#include "shared/rules/crowd.h"

#include <algorithm>
#include <cassert>

namespace woodlouse::rules {
namespace {

constexpr double kMostCells = 40.0;  // along an axis: laid out anew each time

}  // namespace

Crowd::Crowd(const terrain::Rectangle& domain, const Images& images, double distance)
    : images_(images),
      distance_(distance),
      distance2_(distance * distance),
      x_(axis_of(domain.x_min, domain.x_max, distance)),
      y_(axis_of(domain.y_min, domain.y_max, distance)) {
  assert(distance > 0.0);
}

/// Cells no smaller than the distance.
Crowd::Axis Crowd::axis_of(double low, double high, double distance) {
  const double fit = std::min((high - low) / distance, kMostCells);
  const std::size_t cells = fit >= 1.0 ? static_cast<std::size_t>(fit) : 1;
  return {low, static_cast<double>(cells) / (high - low), cells};
}

std::size_t Crowd::Axis::cell_of(double at) const {
  const double cell = (at - low) * per_metre;
  if (!(cell > 0.0)) return 0;
  return cell < static_cast<double>(cells) ? static_cast<std::size_t>(cell) : cells - 1;
}

std::pair<std::size_t, std::size_t> Crowd::around(std::size_t cell, const Axis& axis) const {
  if (images_.wraps())
    return axis.cells > 3 ? std::pair((cell + axis.cells - 1) % axis.cells, std::size_t{3})
                          : std::pair(std::size_t{0}, axis.cells);
  const std::size_t first = cell > 0 ? cell - 1 : 0;
  return {first, std::min(cell + 1, axis.cells - 1) - first + 1};
}

void Crowd::sort_into_cells(std::span<const core::Vec2> places) {
  begins_.assign(x_.cells * y_.cells + 1, 0);
  cells_.clear();
  for (const core::Vec2 place : places) {
    cells_.push_back(
        {static_cast<std::uint32_t>(x_.cell_of(place.x)), static_cast<std::uint32_t>(y_.cell_of(place.y))});
    ++begins_[number_of(cells_.back()) + 1];
  }
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  sorted_.resize(places.size());
  // Backwards, each cell's end moves to its begin.
  std::vector<std::uint32_t>& ends = begins_;
  for (std::size_t k = places.size(); k-- > 0;)
    sorted_[--ends[number_of(cells_[k]) + 1]] = static_cast<std::uint32_t>(k);
  ends.erase(ends.begin());
  ends.push_back(static_cast<std::uint32_t>(places.size()));
}

/// Those of place k with the sorted ones from `begin` to `end` that come after it.
void Crowd::add_pairs(std::size_t k, std::span<const core::Vec2> places, std::uint32_t begin,
                      std::uint32_t end) {
  for (std::uint32_t at = begin; at < end; ++at) {
    const std::uint32_t other = sorted_[at];
    if (other <= k) continue;
    const core::Vec2 between = images_.nearest(places[k], places[other]) - places[k];
    if (core::dot(between, between) < distance2_)
      pairs_.push_back({static_cast<std::uint32_t>(k), other, between});
  }
}

/// The cells need not be more than the crowd: where nothing wraps they are laid over it alone.
void Crowd::lay_cells(std::span<const core::Vec2> places) {
  if (images_.wraps() || places.empty()) return;
  core::Vec2 low = places[0], high = places[0];
  for (const core::Vec2 place : places) {
    low = {std::min(low.x, place.x), std::min(low.y, place.y)};
    high = {std::max(high.x, place.x), std::max(high.y, place.y)};
  }
  x_ = axis_of(low.x, std::max(high.x, low.x + distance_), distance_);
  y_ = axis_of(low.y, std::max(high.y, low.y + distance_), distance_);
}

std::span<const Crowd::Pair> Crowd::pairs(std::span<const core::Vec2> places) {
  pairs_.clear();
  lay_cells(places);
  sort_into_cells(places);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto [column, columns] = around(cells_[k].column, x_);
    const auto [row, rows] = around(cells_[k].row, y_);
    const std::size_t own = pairs_.size();
    for (std::size_t y = 0; y < rows; ++y) {
      const std::size_t begin = (row + y < y_.cells ? row + y : row + y - y_.cells) * x_.cells;
      // Cells beside each other lie behind each other, but over a seam.
      const std::size_t first = std::min(columns, x_.cells - column);
      add_pairs(k, places, begins_[begin + column], begins_[begin + column + first]);
      if (first < columns) add_pairs(k, places, begins_[begin], begins_[begin + columns - first]);
    }
    if (pairs_.size() - own < 2) continue;
    std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(own), pairs_.end(),
              [](const Pair& a, const Pair& b) { return a.second < b.second; });
  }
  return pairs_;
}

}  // namespace woodlouse::rules
