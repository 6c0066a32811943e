#include "client/drawing/lice_on_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client/drawing/labels.h"
#include "client/drawing/palette.h"
#include "client/drawing/pixels.h"
#include "client/drawing/terrain_contour_view.h"
#include "client/ground/relief.h"

namespace woodlouse::client {
namespace {

constexpr int kColumnsForLabels = 60;  ///< below, the list beside the map names the letters
constexpr double kPole = 2.9;          ///< how far the line of the next push reaches, in half lengths

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

/// An ellipse along the direction of travel with a head, `half` pixels long each way, in a dark rim.
void draw_body(const LouseMark& louse, const Badge& badge, double half, const MapCamera& camera,
               const Viewport& viewport, CellBuffer& cells) {
  constexpr double kSlim = 0.6;  // width over length
  const double x = camera.column_of(louse.position);
  const double y = 2.0 * camera.row_of(louse.position);
  if (!(std::abs(x) < 1e5 && std::abs(y) < 1e5)) return;
  const double east = std::cos(louse.attitude.yaw);
  const double north = std::sin(louse.attitude.yaw);
  const int reach = static_cast<int>(std::ceil(half)) + 2;
  const int middle_x = static_cast<int>(std::floor(x));
  const int middle_y = static_cast<int>(std::floor(y));
  for (int j = middle_y - reach; j <= middle_y + reach; ++j) {
    for (int i = middle_x - reach; i <= middle_x + reach; ++i) {
      if (j < 0 || !viewport.holds(i, j / 2)) continue;
      const double dx = i + 0.5 - x;
      const double dy = y - (j + 0.5);
      const double along = dx * east + dy * north;
      const double across = dy * east - dx * north;
      const auto is_within = [&](double more) {
        return std::hypot(along / (half + more), across / (kSlim * half + more)) <= 1.0;
      };
      const bool is_middle = i == middle_x && j == middle_y;  // the least that is seen of one
      if (is_middle || is_within(0.0)) {
        put_pixel(cells, viewport, i, j, Color::of(body_color(badge, along / half)));
      } else if (is_within(1.0)) {
        const Style& style = cells.at(viewport.column + i, viewport.row + j / 2).style;
        put_pixel(cells, viewport, i, j,
                  Color::of(scaled(rgb_of(j % 2 == 0 ? style.foreground : style.background), 0.5)));
      }
    }
  }
  if (!louse.is_you) return;
  const core::Vec2 from = louse.position + (1.7 * half * camera.column) * louse.heading;
  const core::Vec2 to = louse.position + (kPole * half * camera.column) * louse.heading;
  for_line(camera.column_of(from), 2.0 * camera.row_of(from), camera.column_of(to), 2.0 * camera.row_of(to),
           [&](int i, int j, double) {
             put_pixel(cells, viewport, i, j, Color::of({255, 255, 255}));
           });
}

/// A letter on the louse's colour, and where it heads.
void draw_letter(const LouseMark& louse, const Badge& badge, Place at, const Viewport& viewport,
                 CellBuffer& cells) {
  draw_rim(at.column, at.row, viewport, cells);
  Cell& cell = cells.at(viewport.column + at.column, viewport.row + at.row);
  if (cell.glyph == kUpperHalfBlock)
    cell = {static_cast<char32_t>(badge.letter), {Color::of({16, 16, 20}), Color::of(badge.color), kBold}};
  const HeadingGlyph heading = heading_glyph(louse.heading);
  put_over(cells, viewport, at.column + heading.columns, at.row + heading.rows,
           static_cast<char32_t>(heading.glyph), Color::of(louse.is_you ? Rgb{255, 255, 255} : badge.color));
}

}  // namespace

void draw_lice_on_map(const Scene& scene, const Badges& badges, const MapCamera& camera,
                      const Viewport& viewport, LabelPlacer& labels, CellBuffer& cells) {
  auto order = in_drawing_order(scene);
  const bool has_bodies = viewport.size.columns >= kColumnsForBodies;
  const double half = std::clamp(viewport.size.columns / 36.0, 2.4, 4.5);  // pixels
  const Size reach =
      has_bodies ? Size{static_cast<int>(half), static_cast<int>(std::ceil((half + 1.0) / 2.0))} : Size{1, 1};
  const auto place_of = [&](const LouseMark& louse) {
    return camera.cell_of(louse.position, scene.terrain->domain());
  };
  for (const LouseMark* louse : order) {
    draw_trail(*louse, badges.of(louse->id).color, scene.look.color, camera, viewport, cells);
    draw_shadow(*louse, camera, viewport, cells);
    const Place at = place_of(*louse);
    if (has_bodies)
      labels.reserve(at.column - reach.columns, at.row - reach.rows,
                     {2 * reach.columns + 1, 2 * reach.rows + 1});
    else
      labels.reserve(at.column - 1, at.row, {3, 1});
    if (has_bodies && louse->is_you)
      labels.reserve(at, camera.cell_of(louse->position + (kPole * half * camera.column) * louse->heading,
                                        scene.terrain->domain()));
  }
  if (has_bodies)
    for (const LouseMark* louse : order)
      draw_body(*louse, badges.of(louse->id), half, camera, viewport, cells);
  std::reverse(order.begin(), order.end());  // yours first: put_over() keeps what stands
  for (const LouseMark* louse : order) {
    const Place at = place_of(*louse);
    if (louse->is_you) mark_outside(badges.of(louse->id), at, viewport, cells);
    if (!has_bodies && viewport.holds(at.column, at.row))
      draw_letter(*louse, badges.of(louse->id), at, viewport, cells);
  }
  if (!scene.labels || viewport.size.columns < kColumnsForLabels) return;
  for (const LouseMark* louse : order) {
    const Place at = place_of(*louse);
    if (viewport.holds(at.column, at.row))
      draw_label(*louse, badges.of(louse->id), at.column, at.row, reach, scene.look, viewport, labels, cells);
  }
}

}  // namespace woodlouse::client
