#include "shared/rules/crowd.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::rules {
namespace {

// Cells along an axis, at most: laid out anew each time, they must not cost more than those who are in them.
constexpr double kMostCells = 40.0, kCellsOfCrowd = 2.0;  // the latter times the root of how many they are

}  // namespace

Crowd::Crowd(const terrain::Rectangle& domain, const Images& images, double distance)
    : images_(images), domain_(domain), distance_(distance), distance2_(distance * distance) {
  assert(distance > 0.0);
}

/// Cells no smaller than the distance.
Crowd::Axis Crowd::axis_of(double low, double high, double most) const {
  const double fit = std::min((high - low) / distance_, most);
  const std::size_t cells = fit >= 1.0 ? static_cast<std::size_t>(fit) : 1;
  return {low, static_cast<double>(cells) / (high - low), cells};
}

std::uint32_t Crowd::Axis::cell_of(double at) const {
  const double cell = (at - low) * per_metre;
  return static_cast<std::uint32_t>(std::min(std::max(0.0, cell), static_cast<double>(cells - 1)));
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
    cells_.push_back({x_.cell_of(place.x), y_.cell_of(place.y)});
    ++begins_[number_of(cells_.back())];
  }
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  sorted_.resize(places.size());
  // Each cell's end moves to its begin.
  for (std::size_t k = places.size(); k-- > 0;)
    sorted_[--begins_[number_of(cells_[k])]] = {places[k], static_cast<std::uint32_t>(k)};
}

/// Those of place `second` with the sorted ones from `begin` to `end` that come before it.
inline void Crowd::add_pairs(std::uint32_t second, core::Vec2 at, std::uint32_t begin, std::uint32_t end) {
  if (found_.size() < found_count_ + (end - begin)) found_.resize(2 * found_.size() + (end - begin));
  Pair* next = found_.data() + found_count_;
  for (const Place& other : std::span(sorted_).subspan(begin, end - begin)) {
    const core::Vec2 between = images_.nearest(other.at, at) - other.at;
    // Written whether it is one or not, and counted if it is: a jump that nobody foretells costs more.
    *next = {other.index, second, between};
    const bool is_earlier = other.index < second, is_near = core::dot(between, between) < distance2_;
    next += is_earlier & is_near;
  }
  found_count_ = static_cast<std::size_t>(next - found_.data());
}

/// They were found by second; so that they stay, of each first.
void Crowd::sort_by_first(std::size_t places) {
  const auto found = std::span(found_).first(found_count_);
  ends_.assign(places + 1, 0);
  for (const Pair& pair : found) ++ends_[pair.first + 1];
  for (std::size_t k = 1; k < ends_.size(); ++k) ends_[k] += ends_[k - 1];
  pairs_.resize(found.size());
  for (const Pair& pair : found) pairs_[ends_[pair.first]++] = pair;
}

/// Over the crowd alone, but where something wraps.
void Crowd::lay_cells(std::span<const core::Vec2> places) {
  const double most = std::min(kMostCells, kCellsOfCrowd * std::sqrt(static_cast<double>(places.size())));
  if (images_.wraps() || places.empty()) {
    x_ = axis_of(domain_.x_min, domain_.x_max, most);
    y_ = axis_of(domain_.y_min, domain_.y_max, most);
    return;
  }
  core::Vec2 low = places[0], high = places[0];
  for (const core::Vec2 place : places) {
    low = {std::min(low.x, place.x), std::min(low.y, place.y)};
    high = {std::max(high.x, place.x), std::max(high.y, place.y)};
  }
  x_ = axis_of(low.x, std::max(high.x, low.x + distance_), most);
  y_ = axis_of(low.y, std::max(high.y, low.y + distance_), most);
}

std::span<const Crowd::Pair> Crowd::pairs(std::span<const core::Vec2> places) {
  lay_cells(places);
  sort_into_cells(places);
  found_count_ = 0;
  for (std::uint32_t k = 0; k < places.size(); ++k) {
    const auto [column, columns] = around(cells_[k].column, x_);
    const auto [row, rows] = around(cells_[k].row, y_);
    for (std::size_t y = 0; y < rows; ++y) {
      const std::size_t begin = (row + y < y_.cells ? row + y : row + y - y_.cells) * x_.cells;
      // Cells beside each other lie behind each other, but over a seam.
      const std::size_t first = std::min(columns, x_.cells - column);
      add_pairs(k, places[k], begins_[begin + column], begins_[begin + column + first]);
      if (first < columns) add_pairs(k, places[k], begins_[begin], begins_[begin + columns - first]);
    }
  }
  sort_by_first(places.size());
  return pairs_;
}

}  // namespace woodlouse::rules
