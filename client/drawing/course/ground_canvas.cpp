#include "client/drawing/course/ground_canvas.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "client/drawing/palette.h"
#include "client/drawing/pixels.h"
#include "client/ground/relief.h"

namespace woodlouse::client {

GroundCanvas::GroundCanvas(const MapCamera& camera, const Look& look, const Viewport& viewport,
                           CellBuffer& cells)
    : look_(look),
      viewport_(viewport),
      cells_(cells),
      has_pixels_(paints_pixels(look)),
      has_height_(false),
      projector_([camera, dots = has_pixels_ ? 2.0 : 1.0](core::Vec2 p, double) -> std::optional<Spot> {
        return Spot{camera.column_of(p), dots * camera.row_of(p), false};
      }) {}

GroundCanvas::GroundCanvas(const Relief& relief, const ObliqueCamera& camera, const ObliqueLayer& layer,
                           const Look& look, const Viewport& viewport, CellBuffer& cells)
    : look_(look),
      viewport_(viewport),
      cells_(cells),
      has_pixels_(true),
      has_height_(true),
      projector_([&relief, &camera, &layer](core::Vec2 p, double height) -> std::optional<Spot> {
        const auto at = camera.project({p.x, p.y, (relief.sample(p).z + height) * relief.exaggeration()});
        if (!at) return std::nullopt;
        Spot spot{at->x, at->y, false};
        const int width = layer.size.columns;
        const int height_in_dots = 2 * layer.size.rows;
        if (!(at->x >= 0.0 && at->y >= 0.0 && at->x < width && at->y < height_in_dots)) return spot;
        const auto index = static_cast<std::size_t>(at->y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(at->x);
        const double tolerance = 2.0 * camera.metres_per_pixel(at->depth);
        spot.is_hidden = at->depth > static_cast<double>(layer.depth[index]) + tolerance;
        return spot;
      }) {
  assert(paints_pixels(look));
}

Style GroundCanvas::style_of(const Ink& ink) const {
  Style style;
  style.attributes = ink.strength < 0.7 ? kPlain : ink.attributes;
  if (look_.color != ColorMode::kMono)
    style.foreground = Color::of(ink.strength < 0.7 ? scaled(ink.color, 0.6) : ink.color);
  return style;
}

void GroundCanvas::dot(int x, int y, const Ink& ink) {
  if (x < 0 || y < 0 || !viewport_.holds(x, y / dots_per_row())) return;
  const int column = viewport_.column + x;
  const int row = viewport_.row + y / dots_per_row();
  if (!cells_.contains(column, row)) return;
  if (!has_pixels_) {
    if (!is_kept(x, y)) cells_.put(column, row, ink.glyph, style_of(ink));
    return;
  }
  const Cell& cell = cells_.at(column, row);
  const Rgb below = rgb_of(y % 2 == 0 ? cell.style.foreground : cell.style.background);
  const Rgb color = ink.is_set_off ? set_off(ink.color, below) : ink.color;
  put_pixel(cells_, viewport_, x, y, Color::of(ink.strength < 1.0 ? mix(below, color, ink.strength) : color));
}

void GroundCanvas::uncover(int column, int row) {
  if (!has_pixels_ || !viewport_.holds(column, row)) return;
  Cell& cell = cells_.at(viewport_.column + column, viewport_.row + row);
  if (cell.glyph != kUpperHalfBlock)
    cell = {kUpperHalfBlock, {cell.style.background, cell.style.background, kPlain}};
}

void GroundCanvas::dot_of_line(int x, int y, const Ink& ink, int dash, int count) {
  if (dash == 0 || count / dash % 2 == 0) return dot(x, y, ink);
  if (!has_pixels_ || !ink.between) return;
  Ink other = ink;
  other.color = *ink.between;
  dot(x, y, other);
}

void GroundCanvas::line(core::Vec2 from, core::Vec2 to, const Ink& ink, int dash) {
  const auto a = spot(from);
  const auto b = spot(to);
  if (!a || !b) return;
  const double dots = std::max(std::abs(b->x - a->x), std::abs(b->y - a->y));
  if (!(dots < 4096.0)) return;
  const int steps = std::max(1, static_cast<int>(std::ceil(dots)));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const auto here = spot(from + t * (to - from));  // the ground between them is no straight line
    if (here && !here->is_hidden)
      dot_of_line(static_cast<int>(std::floor(here->x)), static_cast<int>(std::floor(here->y)), ink, dash, i);
  }
}

void GroundCanvas::ellipse(core::Vec2 middle, core::Vec2 along, double axis, double across, const Ink& ink,
                           int dash) {
  const auto centre = spot(middle);
  const auto tip = spot(middle + axis * along);
  if (!centre || !tip) return;
  const double dots = std::hypot(tip->x - centre->x, tip->y - centre->y);
  if (!(dots < 4096.0)) return;
  const int steps = std::clamp(static_cast<int>(std::ceil(2.0 * std::numbers::pi * dots)) * 2, 16, 4096);
  int last_x = -1, last_y = -1, count = 0;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / steps;
    const core::Vec2 place = middle + (axis * std::cos(angle)) * along +
                             (across * std::sin(angle)) * core::Vec2{-along.y, along.x};
    const auto here = spot(place);
    if (!here) continue;
    const int x = static_cast<int>(std::floor(here->x));
    const int y = static_cast<int>(std::floor(here->y));
    if (x == last_x && y == last_y) continue;  // a dot is laid on once: what is mixed would add up
    last_x = x, last_y = y;
    if (!here->is_hidden) dot_of_line(x, y, ink, dash, count);
    ++count;
  }
}

void GroundCanvas::disc(core::Vec2 middle, double radius, const Ink& ink) {
  const auto centre = spot(middle);
  if (!has_pixels_ || !centre) return;
  double reach = 0.0;
  for (const core::Vec2 way : {core::Vec2{1.0, 0.0}, core::Vec2{0.0, 1.0}})
    if (const auto rim = spot(middle + radius * way))
      reach = std::max(reach, std::hypot(rim->x - centre->x, rim->y - centre->y));
  constexpr double kLargest = 24.0;  // beyond it the line alone is seen well, and the inside costs too much
  if (!(reach > 0.0 && reach < kLargest)) return;
  // So far apart that none is missed; each is laid on once.
  std::vector<std::pair<int, int>> dots;
  const int steps = static_cast<int>(std::ceil(1.4 * reach));
  for (int j = -steps; j <= steps; ++j)
    for (int i = -steps; i <= steps; ++i) {
      const core::Vec2 off{radius * i / steps, radius * j / steps};
      if (core::dot(off, off) > radius * radius) continue;
      const auto here = spot(middle + off);
      if (here && !here->is_hidden)
        dots.emplace_back(static_cast<int>(std::floor(here->x)), static_cast<int>(std::floor(here->y)));
    }
  std::sort(dots.begin(), dots.end());
  dots.erase(std::unique(dots.begin(), dots.end()), dots.end());
  for (const auto& [x, y] : dots) dot(x, y, ink);
}

bool GroundCanvas::is_free(int column, int row, int columns) const {
  for (int x = column; x < column + columns; ++x) {
    if (!viewport_.holds(x, row)) continue;
    assert(cells_.contains(viewport_.column + x, viewport_.row + row));
    if (is_kept(x, row) ||
        (has_pixels_ && cells_.at(viewport_.column + x, viewport_.row + row).glyph != kUpperHalfBlock))
      return false;
  }
  return true;
}

bool GroundCanvas::write(int column, int row, std::u32string_view text, Rgb color, Attributes attributes) {
  const int end = column + static_cast<int>(text.size()) - 1;
  if (text.empty() || !viewport_.holds(column, row) || !viewport_.holds(end, row)) return false;
  if (!is_free(column, row, static_cast<int>(text.size()))) return false;
  for (const char32_t c : text) {
    if (has_pixels_) {
      put_over(cells_, viewport_, column, row, c, Color::of(color), attributes);
    } else {
      Style style;
      style.attributes = attributes;
      if (look_.color != ColorMode::kMono) style.foreground = Color::of(color);
      cells_.put(viewport_.column + column, viewport_.row + row, c, style);
      keep(column, row);  // texts don't run into each other
    }
    ++column;
  }
  return true;
}

}  // namespace woodlouse::client
