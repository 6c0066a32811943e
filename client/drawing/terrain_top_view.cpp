#include "client/drawing/terrain_top_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "client/drawing/labels.h"
#include "client/drawing/palette.h"
#include "client/drawing/pixels.h"
#include "client/drawing/terrain_contour_view.h"

namespace woodlouse::client {
namespace {

constexpr int kColumnsForLabels = 60;  ///< below, the list beside the map names the letters

void draw_trail(const LouseMark& louse, Rgb color, ColorMode mode, const MapCamera& camera,
                const Viewport& viewport, CellBuffer& cells) {
  for (std::size_t i = 1; i < louse.trail.size(); ++i) {
    const Color paint =
        trail_color(color, 2 * i >= louse.trail.size() ? TrailAge::kRecent : TrailAge::kOld, mode);
    const core::Vec2 a = louse.trail[i - 1];
    const core::Vec2 b = louse.trail[i];
    for_line(camera.column_of(a), 2.0 * camera.row_of(a), camera.column_of(b), 2.0 * camera.row_of(b),
             [&](int x, int y, double) { put_pixel(cells, viewport, x, y, paint); });
  }
}

/// Darkens the pixels around a cell: a louse is set off from any ground.
void draw_rim(int column, int row, const Viewport& viewport, CellBuffer& cells) {
  for (int y = 2 * row - 1; y <= 2 * row + 2; ++y)
    for (int x = column - 1; x <= column + 1; ++x) {
      if (y < 0 || !viewport.holds(x, y / 2)) continue;
      const Style& style = cells.at(viewport.column + x, viewport.row + y / 2).style;
      put_pixel(cells, viewport, x, y,
                Color::of(scaled(rgb_of(y % 2 == 0 ? style.foreground : style.background), 0.55)));
    }
}

/// Of a louse that flies, as far to the south-east as it flies high.
void draw_shadow(const LouseMark& louse, const MapCamera& camera, const Viewport& viewport,
                 CellBuffer& cells) {
  if (louse.above <= 0.0) return;
  const core::Vec2 under = louse.position + louse.above * kShadowWay;
  const int x = static_cast<int>(std::floor(camera.column_of(under)));
  const int y = static_cast<int>(std::floor(2.0 * camera.row_of(under)));
  for (const int beside : {0, 1}) put_pixel(cells, viewport, x + beside, y, Color::of({8, 9, 14}));
}

}  // namespace

double contour_shade(double z, double z_right, double z_below, double interval) {
  constexpr double kDarker = 0.68;
  constexpr double kPixelsApart = 3.0;
  const double rise = std::hypot(z_right - z, z_below - z);
  if (rise < kLeastRise * interval) return 1.0;
  constexpr double kLonely = 14.0;  // pixels between lines beyond which a line half-way helps
  while (rise * kPixelsApart > interval) interval *= 2.0;
  if (rise * kLonely < interval) interval /= 2.0;
  const double here = contour_number(z, interval);
  return here != contour_number(z_right, interval) || here != contour_number(z_below, interval) ? kDarker
                                                                                                : 1.0;
}

std::vector<Cell> top_layer(const Relief& relief, const MapCamera& camera, Size size, ColorMode mode,
                            Paint paint) {
  const double pixel = camera.column;  // a pixel is square: half a row high
  const double interval = relief.contour_interval(2.5 * pixel);
  std::vector<Color> pixels;
  pixels.reserve(static_cast<std::size_t>(size.columns * size.rows * 2));
  for (int y = 0; y < 2 * size.rows; ++y) {
    for (int x = 0; x < size.columns; ++x) {
      const core::Vec2 p = camera.world(x + 0.5, (y + 0.5) / 2.0);
      if (!relief.terrain().domain().contains(p.x, p.y)) {
        pixels.push_back(sky_color(1.0, mode));
        continue;
      }
      const terrain::SurfaceSample s = relief.sample(p);
      if (paint == Paint::kSteepness) {
        pixels.push_back(slope_color(std::hypot(s.zx, s.zy) / (1.15 * relief.steep()), mode));
        continue;
      }
      const double shade = contour_shade(s.z, relief.sample(p + core::Vec2{pixel, 0.0}).z,
                                         relief.sample(p - core::Vec2{0.0, pixel}).z, interval);
      pixels.push_back(
          terrain_color(relief.tone(s.z), relief.brightness(p, s) * relief.tile_shade(p) * shade, mode));
    }
  }
  return cells_of_pixels(pixels, size);
}

void draw_lice_on_map(const Scene& scene, const Badges& badges, const MapCamera& camera,
                      const Viewport& viewport, CellBuffer& cells) {
  const auto order = in_drawing_order(scene);
  const terrain::Rectangle& domain = scene.terrain->domain();
  const auto place_of = [&](const LouseMark& louse) { return camera.cell_of(louse.position, domain); };
  LabelPlacer labels(viewport);
  for (const LouseMark* louse : order) {
    draw_trail(*louse, badges.of(louse->id).color, scene.look.color, camera, viewport, cells);
    draw_shadow(*louse, camera, viewport, cells);
    labels.reserve(place_of(*louse).column - 1, place_of(*louse).row, {3, 1});
  }
  for (auto at = order.rbegin(); at != order.rend(); ++at) {  // yours first: put_over() keeps what stands
    const LouseMark& louse = **at;
    const Badge badge = badges.of(louse.id);
    const auto [column, row] = place_of(louse);
    if (louse.is_you) mark_outside(badge, {column, row}, viewport, cells);
    if (!viewport.holds(column, row)) continue;
    draw_rim(column, row, viewport, cells);
    Cell& cell = cells.at(viewport.column + column, viewport.row + row);
    if (cell.glyph == kUpperHalfBlock)
      cell = {static_cast<char32_t>(badge.letter), {Color::of({16, 16, 20}), Color::of(badge.color), kBold}};
    const HeadingGlyph heading = heading_glyph(louse.heading);
    put_over(cells, viewport, column + heading.columns, row + heading.rows,
             static_cast<char32_t>(heading.glyph),
             Color::of(louse.is_you ? Rgb{255, 255, 255} : badge.color));
  }
  if (!scene.labels || viewport.size.columns < kColumnsForLabels) return;
  for (auto at = order.rbegin(); at != order.rend(); ++at) {
    const LouseMark& louse = **at;
    const auto [column, row] = place_of(louse);
    if (!viewport.holds(column, row)) continue;
    draw_label(louse, badges.of(louse.id), column, row, {1, 1}, scene.look, viewport, labels, cells);
  }
}

}  // namespace woodlouse::client
