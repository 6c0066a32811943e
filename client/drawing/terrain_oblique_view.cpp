#include "client/drawing/terrain_oblique_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "client/drawing/labels.h"
#include "client/drawing/louse_shape.h"
#include "client/drawing/oblique_painter.h"
#include "client/drawing/palette.h"
#include "client/drawing/pixels.h"
#include "client/drawing/terrain_top_view.h"
#include "client/ground/ground_caster.h"

namespace woodlouse::client {
namespace {

Vec3 middle_of(const Relief& relief) {
  const terrain::Rectangle& d = relief.terrain().domain();
  return {(d.x_min + d.x_max) / 2.0, (d.y_min + d.y_max) / 2.0,
          relief.exaggeration() * (relief.lowest() + relief.highest()) / 2.0};
}

/// What a pixel place shows.
struct Seen {
  std::optional<GroundHit> hit;    ///< empty: the sky
  terrain::SurfaceSample surface;  ///< of an upper side, exactly there: a ray meets it up to a few rounds

  [[nodiscard]] bool is_top() const { return hit && hit->side == GroundHit::Side::kTop; }
};

/// contour_shade() between neighbouring pixels of one slope: a neighbour farther than `leap` lies beyond a
/// ridge.
double line_shade(const Seen& here, const Seen& right, const Seen& below, double leap, double interval) {
  const auto is_near = [&](const Seen& next) {
    return next.is_top() && length(next.hit->point - here.hit->point) < leap;
  };
  if (!is_near(right) || !is_near(below)) return 1.0;
  return contour_shade(here.surface.z, right.surface.z, below.surface.z, interval);
}

}  // namespace

ObliqueLayer oblique_layer(const Relief& relief, const ObliqueCamera& camera, Size size, ColorMode mode) {
  const GroundCaster caster(relief, camera);
  const int height = 2 * size.rows;
  // One pixel more to the right and below, for the contours.
  const auto stride = static_cast<std::size_t>(size.columns + 1);
  std::vector<Seen> ground;
  ground.reserve(stride * static_cast<std::size_t>(height + 1));
  for (int y = 0; y <= height; ++y)
    for (int x = 0; x <= size.columns; ++x) {
      Seen seen{caster.cast(x + 0.5, y + 0.5), {}};
      if (seen.is_top()) seen.surface = relief.sample({seen.hit->point.x, seen.hit->point.y});
      ground.push_back(seen);
    }

  const double pixel = camera.metres_per_pixel(length(camera.eye() - middle_of(relief)));
  const double interval = relief.contour_interval(2.5 * pixel);
  ObliqueLayer layer;
  layer.size = size;
  std::vector<Color> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < size.columns; ++x) {
      const auto* here = &ground[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
      layer.depth.push_back(here->hit ? static_cast<float>(here->hit->depth)
                                      : std::numeric_limits<float>::infinity());
      if (!here->hit) {
        pixels.push_back(sky_color((y + 0.5) / height, mode));
      } else if (!here->is_top()) {
        pixels.push_back(edge_color(here->hit->brightness, mode));
      } else {
        const core::Vec2 p{here->hit->point.x, here->hit->point.y};
        const terrain::SurfaceSample& s = here->surface;
        const double shade = line_shade(*here, here[1], here[stride], 12.0 * pixel, interval);
        pixels.push_back(
            terrain_color(relief.tone(s.z), relief.brightness(p, s) * relief.tile_shade(p) * shade, mode));
      }
    }
  }
  layer.cells = cells_of_pixels(pixels, size);
  return layer;
}

void draw_lice_obliquely(const Scene& scene, const Badges& badges, const Relief& relief,
                         const ObliqueCamera& camera, const ObliqueLayer& layer, const Viewport& viewport,
                         LabelPlacer& labels, CellBuffer& cells) {
  ObliquePainter painter(relief, camera, layer, viewport, cells);
  const double half_length_pixels = std::clamp(viewport.size.columns / 26.0, 2.4, 5.5);
  struct Placed {
    const LouseMark* louse;
    Place at;
    Size reach;
  };
  std::vector<Placed> placed;
  const auto order = in_drawing_order(scene);
  for (const LouseMark* louse : order) {
    const Badge badge = badges.of(louse->id);
    for (std::size_t i = 1; i < louse->trail.size(); ++i) {
      const bool is_recent = 2 * i >= louse->trail.size();
      painter.line(
          painter.of_trail(*louse, i - 1), painter.of_trail(*louse, i),
          trail_color(badge.color, is_recent ? TrailAge::kRecent : TrailAge::kOld, scene.look.color));
    }
  }
  for (const LouseMark* louse : order) {  // before all bodies: a stalk stands among them
    if (louse->above <= 0.0) continue;
    const Vec3 foot = painter.over_ground(louse->position);
    const auto at = camera.project(foot);
    if (!at) continue;
    painter.shadow(louse->position, 0.8 * half_length_pixels * camera.metres_per_pixel(at->depth));
    painter.line(foot, painter.over_ground(louse->position, louse->above),
                 trail_color(badges.of(louse->id).color, TrailAge::kOld, scene.look.color));
  }
  for (const LouseMark* louse : order) {
    const Badge badge = badges.of(louse->id);
    const Vec3 foot = painter.over_ground(louse->position, louse->above);
    const auto at = camera.project(foot);
    if (!at) {  // higher than the eye
      if (louse->is_you) mark_outside(badge, {viewport.size.columns / 2, -1}, viewport, cells);
      continue;
    }
    const double half_length = half_length_pixels * camera.metres_per_pixel(at->depth);
    const LouseShape shape(foot, exaggerated(louse->attitude, relief.exaggeration()), half_length);
    painter.solid(shape, half_length, badge, louse->is_you ? Owner::kYou : Owner::kOther);
    if (louse->is_you) {
      // Where the next push goes, which is not always where it rolls.
      const core::Vec2 from = louse->position + (1.7 * half_length) * louse->heading;
      const core::Vec2 to = louse->position + (2.9 * half_length) * louse->heading;
      painter.line(painter.over_ground(from, louse->above), painter.over_ground(to, louse->above),
                   Color::of({255, 255, 255}));
      if (const auto tip = camera.project(painter.over_ground(to, louse->above)))
        labels.reserve(Place{static_cast<int>(at->x), static_cast<int>(at->y) / 2},
                       Place{static_cast<int>(tip->x), static_cast<int>(tip->y) / 2});
    }
    const int reach = static_cast<int>(half_length_pixels);
    const Placed entry{
        louse, {static_cast<int>(at->x), static_cast<int>(at->y) / 2}, {reach, (reach + 1) / 2}};
    labels.reserve(entry.at.column - reach, entry.at.row - entry.reach.rows,
                   {2 * reach + 1, 2 * entry.reach.rows + 1});
    placed.push_back(entry);
  }
  for (const Placed& entry : placed)
    if (entry.louse->is_you) mark_outside(badges.of(entry.louse->id), entry.at, viewport, cells);
  if (!scene.labels) return;
  for (auto entry = placed.rbegin(); entry != placed.rend(); ++entry)
    if (viewport.holds(entry->at.column, entry->at.row))
      draw_label(*entry->louse, badges.of(entry->louse->id), entry->at.column, entry->at.row, entry->reach,
                 scene.look, viewport, labels, cells);
}

}  // namespace woodlouse::client
