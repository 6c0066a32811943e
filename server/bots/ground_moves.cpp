#include "server/bots/ground_moves.h"

#include <algorithm>
#include <cmath>

namespace woodlouse::server::bots {
namespace {

using core::Vec2;

constexpr double kSquare = 2.0;        // [m], about; larger on large maps
constexpr double kMostSquares = 36.0;  // along the longer side
constexpr double kPassing = 5.0;       // from which speed on a pull aside is held against less [m/s]
constexpr std::array<std::array<int, 2>, GroundMoves::kCourses> kCourse = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

}  // namespace

GroundMoves::GroundMoves(const Effort& effort) : effort_(&effort) {
  const terrain::Rectangle& domain = effort.map().terrain->domain();
  const double width = domain.x_max - domain.x_min, height = domain.y_max - domain.y_min;
  const double wanted = std::max(kSquare, std::max(width, height) / kMostSquares);
  columns_ = static_cast<std::size_t>(std::max(3.0, std::round(width / wanted)));
  rows_ = static_cast<std::size_t>(std::max(3.0, std::round(height / wanted)));
  corner_ = {domain.x_min, domain.y_min};
  size_ = {width / static_cast<double>(columns_), height / static_cast<double>(rows_)};
  moves_.reserve(squares() * kCourses * kSpeeds.size());
  for (std::size_t square = 0; square < squares(); ++square) {
    for (std::size_t course = 0; course < kCourses; ++course) {
      for (const double speed : kSpeeds) moves_.push_back(drive(square, course, speed));
    }
  }
}

Vec2 GroundMoves::middle(std::size_t square) const {
  return {corner_.x + (static_cast<double>(square % columns_) + 0.5) * size_.x,
          corner_.y + (static_cast<double>(square / columns_) + 0.5) * size_.y};
}

Vec2 GroundMoves::step(std::size_t course) const {
  return {kCourse[course][0] * size_.x, kCourse[course][1] * size_.y};
}

std::int32_t GroundMoves::neighbour(std::size_t square, std::size_t course) const {
  const auto columns = static_cast<std::int64_t>(columns_), rows = static_cast<std::int64_t>(rows_);
  std::int64_t column = static_cast<std::int64_t>(square % columns_) + kCourse[course][0];
  std::int64_t row = static_cast<std::int64_t>(square / columns_) + kCourse[course][1];
  if (effort_->images().wraps()) {
    column = (column + columns) % columns;
    row = (row + rows) % rows;
  }
  if (column < 0 || column >= columns || row < 0 || row >= rows) return -1;
  return static_cast<std::int32_t>(row * columns + column);
}

GroundMoves::Move GroundMoves::drive(std::size_t square, std::size_t course, double speed) const {
  Move move;
  move.to = neighbour(square, course);
  if (move.to < 0) return move;
  const state::Parameters& physics = effort_->map().definition.physics;
  const Vec2 from = middle(square), by = step(course);
  const Vec2 ahead = direction(by);
  constexpr int kParts = 3;
  const double own = thrust();
  double energy = 0.5 * speed * speed, seconds = 0.0;
  auto here = effort_->ground(from);
  for (int part = 1; part <= kParts; ++part) {
    const auto there = effort_->ground(from + (static_cast<double>(part) / kParts) * by);
    const double rise = there.z - here.z;
    const double ds = std::hypot(length(by) / kParts, rise);
    const double v = std::sqrt(2.0 * energy);
    const double passing = std::min(1.0, kPassing * kPassing / std::max(1e-9, v * v));
    const double aside = passing * std::abs(there.zy * ahead.x - there.zx * ahead.y) * physics.gravity /
                         (1.0 + there.zx * there.zx + there.zy * there.zy);
    const double thrust = std::sqrt(std::max(0.0, own * own - aside * aside));
    const double gain =
        thrust - std::max(0.0, aside - own) - physics.drag * v - physics.gravity * rise / ds;  // [m/s^2]
    const double next = energy + gain * ds;
    if (next < 0.02) {
      // Up until it stands, and back through where it came from.
      const double fall = physics.gravity * rise / ds + thrust;  // on the way back
      const double up = std::max(0.05, 0.0 - gain);
      if (!(speed > 0.0) || rise <= 0.0) return {0.0F, 0.0F, -1, false};
      const double back = v * std::sqrt(std::max(0.1, fall / up));
      const double start = std::sqrt(std::max(0.0, speed * speed + back * back - v * v));
      const double most = std::sqrt(speed * speed + 4.0 * thrust * ds * part);
      return {static_cast<float>(2.0 * seconds + v / up + back / std::max(0.1, fall)),
              static_cast<float>(std::min(start, most)), static_cast<std::int32_t>(square), true};
    }
    const double after = std::sqrt(2.0 * next);
    seconds += 2.0 * ds / (v + after);
    energy = next;
    here = there;
  }
  move.seconds = static_cast<float>(seconds);
  move.speed = static_cast<float>(std::min(kSpeeds.back(), std::sqrt(2.0 * energy)));
  return move;
}

std::size_t GroundMoves::square_at(Vec2 place) const {
  const auto at = [](double x, double size, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(x / size), 0.0, static_cast<double>(count - 1)));
  };
  return at(place.y - corner_.y, size_.y, rows_) * columns_ + at(place.x - corner_.x, size_.x, columns_);
}

std::array<GroundMoves::Share, 4> GroundMoves::around(Vec2 place) const {
  const bool wraps = effort_->images().wraps();
  const auto split = [wraps](double x, double size, std::size_t count, std::array<std::size_t, 2>& at) {
    const double u = x / size - 0.5;
    const double low = std::floor(u);
    const auto index = [&](double k) {
      const auto n = static_cast<double>(count);
      return static_cast<std::size_t>(wraps ? k - n * std::floor(k / n) : std::clamp(k, 0.0, n - 1.0));
    };
    at = {index(low), index(low + 1.0)};
    return u - low;
  };
  std::array<std::size_t, 2> column{}, row{};
  const double fx = split(place.x - corner_.x, size_.x, columns_, column);
  const double fy = split(place.y - corner_.y, size_.y, rows_, row);
  return {{{row[0] * columns_ + column[0], (1.0 - fx) * (1.0 - fy)},
           {row[0] * columns_ + column[1], fx * (1.0 - fy)},
           {row[1] * columns_ + column[0], (1.0 - fx) * fy},
           {row[1] * columns_ + column[1], fx * fy}}};
}

}  // namespace woodlouse::server::bots
