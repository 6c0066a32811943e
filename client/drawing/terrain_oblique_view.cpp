#include "client/drawing/terrain_oblique_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "client/drawing/labels.h"
#include "client/drawing/louse_shape.h"
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

/// contour_shade() between neighbouring pixels of one slope: a neighbour farther than `leap` lies beyond a
/// ridge.
double line_shade(const Relief& relief, const std::optional<GroundHit>& here,
                  const std::optional<GroundHit>& right, const std::optional<GroundHit>& below, double leap,
                  double interval) {
  const auto is_near = [&](const std::optional<GroundHit>& next) {
    return next && next->side == GroundHit::Side::kTop && length(next->point - here->point) < leap;
  };
  if (!is_near(right) || !is_near(below)) return 1.0;
  const double up = relief.exaggeration();
  return contour_shade(here->point.z / up, right->point.z / up, below->point.z / up, interval);
}

/// Paints over the copied layer what is not hidden by it.
class Painter {
 public:
  Painter(const Relief& relief, const ObliqueCamera& camera, const ObliqueLayer& layer,
          const Viewport& viewport, CellBuffer& cells)
      : relief_(relief),
        camera_(camera),
        viewport_(viewport),
        cells_(cells),
        width_(layer.size.columns),
        height_(2 * layer.size.rows),
        ground_(layer.depth),
        bodies_(layer.depth.size(), std::numeric_limits<float>::infinity()) {}

  [[nodiscard]] Vec3 on_ground(core::Vec2 p) const {
    return {p.x, p.y, relief_.sample(p).z * relief_.exaggeration()};
  }

  void line(Vec3 from, Vec3 to, Color color) {
    const auto a = camera_.project(from);
    const auto b = camera_.project(to);
    if (!a || !b) return;
    const double tolerance = 2.0 * camera_.metres_per_pixel(a->depth);
    for_line(a->x, a->y, b->x, b->y, [&](int x, int y, double t) {
      if (contains(x, y) && a->depth + (b->depth - a->depth) * t < ground_[index(x, y)] + tolerance)
        put_pixel(cells_, viewport_, x, y, color);
    });
  }

  /// Yours shows through others that stand less than its length before it.
  void solid(const LouseShape& shape, double half_length, Rgb color, Owner owner) {
    const double favour = owner == Owner::kYou ? 2.0 * half_length : 0.0;
    const auto at = camera_.project(shape.centre());
    if (!at) return;
    const double reach = half_length / camera_.metres_per_pixel(at->depth) + 1.0;
    for (int y = static_cast<int>(at->y - reach); y <= static_cast<int>(at->y + reach); ++y) {
      for (int x = static_cast<int>(at->x - reach); x <= static_cast<int>(at->x + reach); ++x) {
        if (!contains(x, y)) continue;
        const auto hit = shape.hit(camera_.eye(), camera_.ray(x + 0.5, y + 0.5));
        if (!hit || hit->way > ground_[index(x, y)] + 0.5 * half_length) continue;
        if (hit->way - favour > bodies_[index(x, y)]) continue;
        bodies_[index(x, y)] = static_cast<float>(hit->way - favour);
        put_pixel(cells_, viewport_, x, y, Color::of(skin(*hit, color)));
      }
    }
  }

 private:
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// Three brightnesses only: a moving louse then changes fewer cells.
  static Rgb skin(const LouseShape::Hit& hit, Rgb color) {
    constexpr Vec3 kSun{-0.55, 0.2, 0.81};
    const double lit = dot(hit.normal, kSun);
    const double brightness = lit > 0.55 ? 1.0 : lit > 0.1 ? 0.78 : 0.56;
    constexpr double kNeck = 0.42;
    return scaled(hit.along > kNeck ? Rgb{255, 255, 250} : color, brightness);
  }

  const Relief& relief_;
  const ObliqueCamera& camera_;
  const Viewport& viewport_;
  CellBuffer& cells_;
  int width_;
  int height_;
  const std::vector<float>& ground_;  ///< depth of each pixel
  std::vector<float> bodies_;         ///< depth of the lice painted so far
};

}  // namespace

ObliqueLayer oblique_layer(const Relief& relief, const ObliqueCamera& camera, Size size, ColorMode mode) {
  const GroundCaster caster(relief, camera);
  const int height = 2 * size.rows;
  // One pixel more to the right and below, for the contours.
  const auto stride = static_cast<std::size_t>(size.columns + 1);
  std::vector<std::optional<GroundHit>> ground;
  ground.reserve(stride * static_cast<std::size_t>(height + 1));
  for (int y = 0; y <= height; ++y)
    for (int x = 0; x <= size.columns; ++x) ground.push_back(caster.cast(x + 0.5, y + 0.5));

  const double pixel = camera.metres_per_pixel(length(camera.eye() - middle_of(relief)));
  const double interval = relief.contour_interval(2.5 * pixel);
  ObliqueLayer layer;
  layer.size = size;
  std::vector<Color> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < size.columns; ++x) {
      const auto* here = &ground[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
      layer.depth.push_back(*here ? static_cast<float>((*here)->depth)
                                  : std::numeric_limits<float>::infinity());
      if (!*here) {
        pixels.push_back(sky_color((y + 0.5) / height, mode));
      } else if ((*here)->side == GroundHit::Side::kEdge) {
        pixels.push_back(edge_color((*here)->brightness, mode));
      } else {
        const core::Vec2 p{(*here)->point.x, (*here)->point.y};
        const terrain::SurfaceSample s = relief.sample(p);
        const double shade = line_shade(relief, *here, here[1], here[stride], 12.0 * pixel, interval);
        pixels.push_back(terrain_color(relief.tone(s.z), relief.brightness(p, s) * shade, mode));
      }
    }
  }
  layer.cells = cells_of_pixels(pixels, size);
  return layer;
}

void draw_lice_obliquely(const Scene& scene, const Badges& badges, const Relief& relief,
                         const ObliqueCamera& camera, const ObliqueLayer& layer, const Viewport& viewport,
                         CellBuffer& cells) {
  Painter painter(relief, camera, layer, viewport, cells);
  LabelPlacer labels(viewport);
  const double half_length_pixels = std::clamp(viewport.size.columns / 32.0, 2.2, 5.0);
  struct Placed {
    const LouseMark* louse;
    int column;
    int row;
    Size reach;
  };
  std::vector<Placed> placed;
  for (const LouseMark* louse : in_drawing_order(scene)) {
    const Badge badge = badges.of(louse->id);
    for (std::size_t i = 1; i < louse->trail.size(); ++i) {
      const bool is_recent = 2 * i >= louse->trail.size();
      painter.line(
          painter.on_ground(louse->trail[i - 1]), painter.on_ground(louse->trail[i]),
          trail_color(badge.color, is_recent ? TrailAge::kRecent : TrailAge::kOld, scene.look.color));
    }
  }
  for (const LouseMark* louse : in_drawing_order(scene)) {
    const Vec3 ground = painter.on_ground(louse->position);
    const auto at = camera.project(ground);
    if (!at) continue;
    const double half_length = half_length_pixels * camera.metres_per_pixel(at->depth);
    const LouseShape shape(ground, exaggerated(louse->attitude, relief.exaggeration()), half_length);
    painter.solid(shape, half_length, badges.of(louse->id).color,
                  louse->is_you ? Owner::kYou : Owner::kOther);
    if (louse->is_you) {
      // Where the next push goes, which is not always where it rolls.
      const core::Vec2 from = louse->position + (1.7 * half_length) * louse->heading;
      const core::Vec2 to = louse->position + (2.9 * half_length) * louse->heading;
      painter.line(painter.on_ground(from), painter.on_ground(to), Color::of({255, 255, 255}));
    }
    const int reach = static_cast<int>(half_length_pixels);
    const Placed entry{louse, static_cast<int>(at->x), static_cast<int>(at->y) / 2, {reach, (reach + 1) / 2}};
    labels.reserve(entry.column - reach, entry.row - entry.reach.rows,
                   {2 * reach + 1, 2 * entry.reach.rows + 1});
    placed.push_back(entry);
  }
  if (!scene.labels) return;
  for (auto entry = placed.rbegin(); entry != placed.rend(); ++entry)
    if (viewport.holds(entry->column, entry->row))
      draw_label(*entry->louse, badges.of(entry->louse->id), entry->column, entry->row, entry->reach,
                 scene.look, viewport, labels, cells);
}

}  // namespace woodlouse::client
