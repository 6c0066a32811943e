#include "client/drawing/compose.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "client/drawing/badges.h"
#include "client/drawing/course/board.h"
#include "client/drawing/course/course_marks.h"
#include "client/drawing/hud.h"
#include "client/drawing/layout.h"
#include "client/drawing/overlays.h"
#include "client/drawing/terrain_contour_view.h"
#include "client/drawing/terrain_oblique_view.h"
#include "client/drawing/terrain_top_view.h"
#include "client/ground/map_camera.h"
#include "client/ground/oblique_camera.h"
#include "client/ground/relief.h"

namespace woodlouse::client {
namespace {

void copy_layer(const std::vector<Cell>& layer, const Viewport& viewport, CellBuffer& cells) {
  auto cell = layer.begin();
  for (int row = 0; row < viewport.size.rows; ++row)
    for (int column = 0; column < viewport.size.columns; ++column)
      cells.at(viewport.column + column, viewport.row + row) = *cell++;
}

/// Whom View::kFollow follows; null: nobody is there.
const LouseMark* followed(const Scene& scene) {
  const LouseMark* result = nullptr;
  const auto order = in_drawing_order(scene);
  for (const LouseMark* louse : order) {
    if (louse->is_you) return louse;
    if (louse->id == scene.follow_id) result = louse;
  }
  return result != nullptr || order.empty() ? result : order.front();
}

}  // namespace

struct Composer::Layers {
  /// What the layer in `cells` (and `oblique`) was computed for.
  struct Key {
    std::shared_ptr<const terrain::Terrain> terrain;
    Look look;
    View view = View::kMap;
    Size size;
    core::Vec2 centre;  ///< View::kFollow only
    double zoom = 1.0;  ///< View::kFollow only
    friend bool operator==(const Key&, const Key&) = default;
  };

  std::optional<Relief> relief;
  std::optional<Key> key;
  std::optional<core::Vec2> centre;  ///< where a following camera stands until its louse nears the edge
  MapCamera camera;
  std::vector<Cell> cells;
  std::optional<ObliqueCamera> oblique_camera;
  ObliqueLayer oblique;

  void follow(const Scene& scene, Size size);
  void prepare(const Scene& scene, Size size);
  void draw_map(const Scene& scene, const Badges& badges, const Viewport& viewport, CellBuffer& cells);
};

/// Moves the camera in leaps: a map that scrolls with the louse would be written whole every frame.
void Composer::Layers::follow(const Scene& scene, Size size) {
  const LouseMark* louse = followed(scene);
  if (louse == nullptr) return;
  const terrain::Rectangle& d = relief->terrain().domain();
  const MapCamera whole = camera_for(d, size);
  const double zoom = follow_zoom(scene.zoom);
  const double half_width = whole.column * size.columns / (2.0 * zoom);
  const double half_height = whole.row * size.rows / (2.0 * zoom);
  // Each way by itself: along the map's edge the louse stays off the middle for long.
  const auto next = [](double at, std::optional<double> now, double half, double low, double high) {
    constexpr double kNearEdge = 0.6;
    if (now && std::abs(at - *now) < kNearEdge * half) return *now;
    return high - low <= 2.0 * half ? (low + high) / 2.0 : std::clamp(at, low + half, high - half);
  };
  const auto x = centre ? std::optional(centre->x) : std::nullopt;
  const auto y = centre ? std::optional(centre->y) : std::nullopt;
  centre = core::Vec2{next(louse->position.x, x, half_width, d.x_min, d.x_max),
                      next(louse->position.y, y, half_height, d.y_min, d.y_max)};
}

void Composer::Layers::prepare(const Scene& scene, Size size) {
  if (!relief || relief->shared_terrain() != scene.terrain) {
    relief.emplace(scene.terrain);
    centre.reset();
  }
  const bool pixels = paints_pixels(scene.look);
  const bool is_follow = scene.view == View::kFollow;
  if (is_follow) follow(scene, size);
  const core::Vec2 middle = is_follow && centre ? *centre : core::Vec2{};
  Key wanted{scene.terrain, scene.look, scene.view, size, middle, is_follow ? scene.zoom : 1.0};
  if (key == wanted) return;
  key = std::move(wanted);
  oblique_camera.reset();
  const double zoom = follow_zoom(scene.zoom);
  if (pixels && (scene.view == View::kOblique || is_follow)) {
    oblique_camera = is_follow && centre ? oblique_camera_around(*relief, *centre, zoom, size)
                                         : oblique_camera_for(*relief, size);
    oblique = oblique_layer(*relief, *oblique_camera, size, scene.look.color);
    cells = oblique.cells;
    return;
  }
  const MapCamera whole = camera_for(relief->terrain().domain(), size);
  camera = is_follow && centre ? camera_around(*centre, whole.row / zoom, size) : whole;
  if (pixels)
    cells = top_layer(*relief, camera, size, scene.look.color,
                      scene.view == View::kSlope ? Paint::kSteepness : Paint::kElevation);
  else
    cells = scene.view == View::kSlope ? slope_character_layer(*relief, camera, size, scene.look)
                                       : contour_layer(*relief, camera, size, scene.look);
}

void Composer::Layers::draw_map(const Scene& scene, const Badges& badges, const Viewport& viewport,
                                CellBuffer& out) {
  if (scene.terrain == nullptr) {
    out.text(viewport.column + 2, viewport.row + viewport.size.rows / 2, "waiting for the map ...", {});
    return;
  }
  prepare(scene, viewport.size);
  copy_layer(cells, viewport, out);
  GroundCanvas canvas = oblique_camera
                            ? GroundCanvas(*relief, *oblique_camera, oblique, scene.look, viewport, out)
                            : GroundCanvas(camera, scene.look, viewport, out);
  if (canvas.has_pixels()) draw_marks(scene, badges, canvas);
  if (oblique_camera) {
    draw_lice_obliquely(scene, badges, *relief, *oblique_camera, oblique, viewport, out);
  } else if (canvas.has_pixels()) {
    draw_lice_on_map(scene, badges, camera, viewport, out);
  } else {  // over trails, which are as wide as the marks are there
    draw_lice_as_letters(scene, badges, camera, viewport, out);
    for (const LouseMark& louse : scene.lice) {
      const int column = static_cast<int>(std::floor(camera.column_of(louse.position)));
      const int row = static_cast<int>(std::floor(camera.row_of(louse.position)));
      const HeadingGlyph heading = heading_glyph(louse.heading);
      canvas.keep(column, row);
      canvas.keep(column + heading.columns, row + heading.rows);
    }
    draw_marks(scene, badges, canvas);
  }
  draw_mark_labels(scene, canvas);
}

Composer::Composer() : layers_(std::make_unique<Layers>()) {}
Composer::~Composer() = default;

View default_view(const Look& look, Size size) {
  return paints_pixels(look) && size.columns >= 100 && size.rows >= 30 ? View::kOblique : View::kMap;
}

void Composer::draw(const Scene& scene, CellBuffer& cells) {
  cells.clear();
  const Size size = cells.size();
  if (size.columns < kSmallestSize.columns || size.rows < kSmallestSize.rows) {
    draw_too_small(scene, cells);
    return;
  }
  const Layout layout = layout_for(size, scene.look, scene.replay ? Foot::kScrubberAndKeys : Foot::kKeys);
  const Badges badges(scene);
  layers_->draw_map(scene, badges, layout.map, cells);
  draw_panel(scene, badges, layout.panel, cells);
  draw_status_line(scene, cells);
  draw_course_board(scene, badges, layout.map, cells);
  draw_key_line(scene, layout, cells);
  draw_overlay(scene, badges, cells);
}

}  // namespace woodlouse::client
