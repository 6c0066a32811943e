#include "server/frames/row_sheet.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::server {
namespace {

constexpr double kLiceACell = 4.0;
constexpr std::size_t kMostCells = 64;  // along an axis

bool is_before(const RowSheet::Found& a, const RowSheet::Found& b) {
  return a.row != b.row ? a.row < b.row : a.square < b.square;
}

}  // namespace

void RowSheet::begin(const Ground& ground) {
  ground_ = ground;
  text_.clear();
  tail_.clear();
  rows_.clear();
}

void RowSheet::added(const Row& row) {
  assert(row.begin <= row.end && row.end == text_.size());
  assert(rows_.empty() || rows_.back().id < row.id);
  rows_.push_back(row);
}

void RowSheet::end(std::string_view tail) {
  tail_ = tail;
  low_ = high_ = rows_.empty() ? core::Vec2{} : rows_.front().place;
  for (const Row& row : rows_) {
    low_ = {std::min(low_.x, row.place.x), std::min(low_.y, row.place.y)};
    high_ = {std::max(high_.x, row.place.x), std::max(high_.y, row.place.y)};
  }
  const auto wanted = static_cast<std::size_t>(std::sqrt(static_cast<double>(rows_.size()) / kLiceACell));
  side_ = std::clamp<std::size_t>(wanted, 1, kMostCells);
  cell_ = (1.0 / static_cast<double>(side_)) * (high_ - low_);
  const auto cell_of = [this](core::Vec2 place) {
    const std::size_t column = cells_between(place.x, place.x, low_.x, cell_.x).first;
    return cells_between(place.y, place.y, low_.y, cell_.y).first * side_ + column;
  };
  // Counted, then filled from the back: each cell's rows stand in their order.
  cell_ends_.assign(side_ * side_, 0);
  by_cell_.resize(rows_.size());
  for (const Row& row : rows_) ++cell_ends_[cell_of(row.place)];
  for (std::size_t k = 1; k < cell_ends_.size(); ++k) cell_ends_[k] += cell_ends_[k - 1];
  next_.assign(cell_ends_.begin(), cell_ends_.end());
  for (std::size_t k = rows_.size(); k-- > 0;) by_cell_[--next_[cell_of(rows_[k].place)]] = k;
}

/// The cells along an axis that the interval meets; one at least.
RowSheet::Span RowSheet::cells_between(double low, double high, double origin, double cell) const {
  const auto index = [&](double at) -> std::size_t {
    const double cells = cell > 0.0 ? (at - origin) / cell : 0.0;
    if (!(cells > 0.0)) return 0;
    return cells >= static_cast<double>(side_) ? side_ - 1 : static_cast<std::size_t>(cells);
  };
  return {index(low), index(high) + 1};
}

std::optional<std::size_t> RowSheet::find(std::uint32_t id) const {
  const auto found = std::lower_bound(rows_.begin(), rows_.end(), id,
                                      [](const Row& row, std::uint32_t wanted) { return row.id < wanted; });
  if (found == rows_.end() || found->id != id) return std::nullopt;
  return static_cast<std::size_t>(found - rows_.begin());
}

void RowSheet::search_image(core::Vec2 middle, double radius, std::vector<Found>& found) const {
  if (middle.x + radius < low_.x || middle.x - radius > high_.x || middle.y + radius < low_.y ||
      middle.y - radius > high_.y)
    return;
  const Span columns = cells_between(middle.x - radius, middle.x + radius, low_.x, cell_.x);
  const Span lines = cells_between(middle.y - radius, middle.y + radius, low_.y, cell_.y);
  for (std::size_t line = lines.first; line < lines.end; ++line) {
    // Cells beside one another stand beside one another.
    const std::size_t first = line * side_ + columns.first;
    const std::size_t begin = first == 0 ? 0 : cell_ends_[first - 1];
    const std::size_t end = cell_ends_[line * side_ + columns.end - 1];
    for (std::size_t k = begin; k < end; ++k) {
      const core::Vec2 way = rows_[by_cell_[k]].place - middle;
      const double square = core::dot(way, way);
      if (square <= radius * radius) found.push_back({by_cell_[k], square});
    }
  }
}

void RowSheet::search(core::Vec2 middle, double radius, std::vector<Found>& found) const {
  found.clear();
  const int x_images = ground_.period.x > 0.0 ? 1 : 0;
  const int y_images = ground_.period.y > 0.0 ? 1 : 0;
  for (int y = -y_images; y <= y_images; ++y)
    for (int x = -x_images; x <= x_images; ++x)
      search_image(middle + core::Vec2{x * ground_.period.x, y * ground_.period.y}, radius, found);
  if (x_images + y_images == 0) return;
  // Of one that is in several images the nearest.
  std::sort(found.begin(), found.end(), is_before);
  found.erase(
      std::unique(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.row == b.row; }),
      found.end());
}

void RowSheet::within(const Circle& circle, std::vector<Found>& found) const {
  assert(circle.radius > 0.0 && circle.most > 0);
  found.clear();
  if (rows_.empty()) return;
  // No louse is farther from it than that.
  const core::Vec2 size = high_ - low_, way = circle.middle - low_;
  const double farthest = std::abs(way.x) + std::abs(way.y) + size.x + size.y + 1.0;
  const double radius = std::min(circle.radius, farthest);
  // Where the nearest few are wanted, most are not looked at: first where so many would be, spread evenly.
  double tried = radius;
  if (circle.most < rows_.size())
    tried = std::min(radius, (size.x + size.y + 1.0) * std::sqrt(static_cast<double>(circle.most) /
                                                                 static_cast<double>(rows_.size())));
  for (;; tried = std::min(radius, 2.0 * tried)) {
    search(circle.middle, tried, found);
    if (found.size() >= circle.most || tried >= radius) break;
  }
  if (found.size() > circle.most) {
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(circle.most);
    std::nth_element(found.begin(), end, found.end(), is_nearer);
    found.erase(end, found.end());
  }
  std::sort(found.begin(), found.end(), is_before);
}

}  // namespace woodlouse::server
