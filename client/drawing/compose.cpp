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
#include "client/drawing/landmarks.h"
#include "client/drawing/layout.h"
#include "client/drawing/lice_on_map.h"
#include "client/drawing/overlays.h"
#include "client/drawing/terrain_contour_view.h"
#include "client/drawing/terrain_oblique_view.h"
#include "client/drawing/terrain_top_view.h"
#include "client/ground/follow_camera.h"
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
    Landmarks landmarks;
    Look look;
    bool by_steepness = false;
    Size size;
    std::optional<MapCamera> above;        ///< one of both
    std::optional<ObliqueCamera> oblique;  ///< ...
    friend bool operator==(const Key&, const Key&) = default;
  };

  std::optional<Relief> relief;
  std::optional<FollowCamera> follower;
  std::optional<Key> key;
  std::vector<Cell> cells;
  ObliqueLayer oblique;

  void see(const Scene& scene, Size size);
  [[nodiscard]] Key wanted(const Scene& scene, Size size);
  void prepare(const Scene& scene, Size size);
  InSight draw_map(const Scene& scene, const Badges& badges, const Viewport& viewport, CellBuffer& cells);
};

/// Makes the relief and the follower those of this map and size.
void Composer::Layers::see(const Scene& scene, Size size) {
  if (!relief || relief->shared_terrain() != scene.terrain) {
    follower.reset();
    relief.emplace(scene.terrain);
  }
  if (!follower || follower->size() != size) follower.emplace(*relief, size);
}

Composer::Layers::Key Composer::Layers::wanted(const Scene& scene, Size size) {
  const bool pixels = paints_pixels(scene.look);
  const Margin margin = pixels ? kPixelMargin : kCharacterMargin;
  const LouseMark* louse = scene.view == View::kFollow ? followed(scene) : nullptr;
  const double zoom = follow_zoom(scene.zoom);
  Key result{scene.terrain, scene.landmarks, scene.look, scene.view == View::kSlope, size, {}, {}};
  if (pixels && louse != nullptr)
    result.oblique =
        follower->before({louse->position.x, louse->position.y,
                          (relief->sample(louse->position).z + louse->above) * relief->exaggeration()},
                         zoom);
  else if (pixels && (scene.view == View::kOblique || scene.view == View::kFollow))
    result.oblique = follower->whole();
  else if (louse != nullptr)
    result.above = follower->over(louse->position, zoom, margin);
  else
    result.above = camera_for(relief->terrain().domain(), size, margin);
  return result;
}

void Composer::Layers::prepare(const Scene& scene, Size size) {
  see(scene, size);
  Key next = wanted(scene, size);
  if (key == next) return;
  key = std::move(next);
  const bool pixels = paints_pixels(scene.look);
  const terrain::Rectangle& domain = relief->terrain().domain();
  if (key->oblique) {
    oblique = oblique_layer(*relief, *key->oblique, size, scene.look.color);
    mark_obliquely(scene.landmarks, *relief, *key->oblique, oblique);
    return;
  }
  if (pixels) {
    cells = top_layer(*relief, *key->above, size, scene.look.color,
                      key->by_steepness ? Paint::kSteepness : Paint::kElevation);
    mark_in_pixels(scene.landmarks, domain, *key->above, size, cells);
    return;
  }
  cells = key->by_steepness ? slope_character_layer(*relief, *key->above, size, scene.look)
                            : contour_layer(*relief, *key->above, size, scene.look);
  mark_in_characters(scene.landmarks, domain, *key->above, size, scene.look, cells);
}

InSight Composer::Layers::draw_map(const Scene& scene, const Badges& badges, const Viewport& viewport,
                                   CellBuffer& out) {
  if (scene.terrain == nullptr) {
    out.text(viewport.column + 2, viewport.row + viewport.size.rows / 2, "waiting for the map ...", {});
    return {};
  }
  prepare(scene, viewport.size);
  const bool is_oblique = key->oblique.has_value();
  copy_layer(is_oblique ? oblique.cells : cells, viewport, out);
  GroundCanvas canvas = is_oblique ? GroundCanvas(*relief, *key->oblique, oblique, scene.look, viewport, out)
                                   : GroundCanvas(*key->above, scene.look, viewport, out);
  if (canvas.has_pixels()) draw_marks(scene, badges, canvas);
  InSight in_sight{{}, next_gate_cells(scene, canvas)};
  LabelPlacer labels(viewport);
  for (const Viewport& taken : in_sight.gate) labels.reserve(taken.column, taken.row, taken.size);
  if (is_oblique) {
    draw_lice_obliquely(scene, badges, *relief, *key->oblique, oblique, viewport, labels, out);
  } else if (canvas.has_pixels()) {
    draw_lice_on_map(scene, badges, *key->above, viewport, labels, out);
  } else {  // over trails, which are as wide as the marks are there
    draw_lice_as_letters(scene, badges, *key->above, viewport, out);
    for (const LouseMark& louse : scene.lice) {
      const Place at = key->above->cell_of(louse.position, scene.terrain->domain());
      const HeadingGlyph heading = heading_glyph(louse.heading);
      canvas.keep(at.column, at.row);
      canvas.keep(at.column + heading.columns, at.row + heading.rows);
    }
    draw_marks(scene, badges, canvas);
  }
  for (const LouseMark& louse : scene.lice) {  // no text over yours
    if (const auto at = louse.is_you ? canvas.spot(louse.position, louse.above) : std::nullopt)
      in_sight.yours = Place{static_cast<int>(std::floor(at->x)),
                             static_cast<int>(std::floor(at->y / canvas.dots_per_row()))};
    if (!louse.is_you || !in_sight.yours || !canvas.has_pixels()) continue;
    constexpr int kColumns = 3, kRows = 1;
    for (int y = -kRows; y <= kRows; ++y)
      for (int x = -kColumns; x <= kColumns; ++x)
        canvas.keep(in_sight.yours->column + x, in_sight.yours->row + y);
  }
  draw_next_gate_over_lice(scene, canvas);
  draw_mark_labels(scene, badges, in_sight.gate, canvas);
  return in_sight;
}

Composer::Composer() : layers_(std::make_unique<Layers>()) {}
Composer::~Composer() = default;

View default_view(const Look& look, Size size, state::Mode driven) {
  if (!paints_pixels(look) || size.columns < 100 || size.rows < 30) return View::kMap;
  return driven == state::Mode::kRace ? View::kFollow : View::kOblique;
}

core::Vec2 up_in_picture(View view, const Look& look) {
  const bool is_oblique = paints_pixels(look) && (view == View::kOblique || view == View::kFollow);
  return is_oblique ? oblique_up() : core::Vec2{0.0, 1.0};
}

void Composer::draw(const Scene& scene, CellBuffer& cells) {
  cells.clear();
  const Size size = cells.size();
  if (size.columns < kSmallestSize.columns || size.rows < kSmallestSize.rows) {
    draw_too_small(scene, cells);
    return;
  }
  const Foot foot = scene.replay ? Foot::kScrubberAndKeys : Foot::kKeys;
  const int columns = layout_for(size, scene.look, foot).map.size.columns;
  const Layout layout = layout_for(size, scene.look, foot, line_rows(scene, columns));
  const Badges badges(scene);
  const InSight in_sight = layers_->draw_map(scene, badges, layout.map, cells);
  draw_panel(scene, badges, layout.panel, cells);
  draw_status_line(scene, cells);
  draw_course_board(scene, badges, layout, in_sight, cells);
  draw_key_line(scene, layout, cells);
  draw_overlay(scene, badges, cells);
}

}  // namespace woodlouse::client
