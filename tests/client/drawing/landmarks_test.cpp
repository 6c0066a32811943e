// What a flat map shows: no contours of rounding, but tiles, walls, and what pulls; and bodies that fly.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <set>
#include <tuple>

#include "client/drawing/compose.h"
#include "client/drawing/landmarks.h"
#include "client/drawing/layout.h"
#include "client/drawing/palette.h"
#include "client/drawing/terrain_contour_view.h"
#include "client/drawing/terrain_top_view.h"
#include "client/ground/follow_camera.h"
#include "shared/terrain/terrain.h"
#include "tests/client/drawing/shipped_maps.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

std::shared_ptr<const terrain::Terrain> plain(double height) {
  terrain::HeightGrid grid;
  grid.columns = grid.rows = 9;
  grid.x_origin = grid.y_origin = -20.0;
  grid.dx = grid.dy = 5.0;
  grid.heights.assign(81, height);
  return std::make_shared<terrain::Terrain>(terrain::BicubicSpline(grid));
}

Scene scene_on(double height, Look look, View view) {
  Scene scene;
  scene.terrain = plain(height);
  scene.look = look;
  scene.view = view;
  return scene;
}

constexpr Look kMonochrome{ColorMode::kMono, GlyphSet::kAscii};
constexpr Look kHalves{ColorMode::kTruecolor, GlyphSet::kHalfBlocks};

CellBuffer drawn(const Scene& scene) {
  Composer composer;
  CellBuffer cells({80, 24});
  composer.draw(scene, cells);
  return cells;
}

}  // namespace

TEST_CASE("level ground has no contours, whatever its heights round to") {
  for (const double height : {0.0, 0.1, 3.0, -1.0 / 3.0, 0.43, 1234.5}) {
    const Relief relief(plain(height));
    REQUIRE(relief.is_flat());
    const Size size{47, 21};
    const MapCamera camera = camera_for(relief.terrain().domain(), size, kCharacterMargin);
    std::set<char32_t> glyphs;
    for (const Cell& cell : contour_layer(relief, camera, size, kMonochrome)) glyphs.insert(cell.glyph);
    CHECK(glyphs == std::set<char32_t>{U' ', U'+'});
    std::set<int> greens;  // the sky's apart: two tiles
    for (const Cell& cell : top_layer(relief, camera, size, ColorMode::kTruecolor, Paint::kElevation))
      greens.insert(cell.style.foreground.rgb.g);
    CHECK(greens.size() == 3);
    FollowCamera follower(relief, size);
    const ObliqueLayer layer = oblique_layer(relief, follower.whole(), size, ColorMode::kTruecolor);
    std::set<std::tuple<int, int, int>> ground;
    for (std::size_t i = 0; i < layer.depth.size(); ++i) {
      const Cell& cell = layer.cells[i / 94 * 47 + i % 47];
      const Color pixel = i / 47 % 2 == 0 ? cell.style.foreground : cell.style.background;
      if (pixel.rgb.g > pixel.rgb.r + 20) ground.insert({pixel.rgb.r, pixel.rgb.g, pixel.rgb.b});
    }
    CHECK(ground.size() == 2);
  }
}

TEST_CASE("edges and what pulls are seen in every look and view, and each kind of edge is another picture") {
  for (const Look look : {kMonochrome, kHalves})
    for (const View view : {View::kMap, View::kOblique, View::kSlope}) {
      Scene scene = scene_on(0.0, look, view);
      const CellBuffer walls = drawn(scene);
      scene.landmarks.edges = state::Edges::kWrap;
      const CellBuffer wraps = drawn(scene);
      scene.landmarks.edges = state::Edges::kOpen;
      const CellBuffer open = drawn(scene);
      scene.landmarks.core_radius = 0.2;
      const CellBuffer pulls = drawn(scene);
      CHECK_FALSE(walls == wraps);
      CHECK_FALSE(wraps == open);
      CHECK_FALSE(walls == open);
      CHECK_FALSE(pulls == open);
    }
}

TEST_CASE("who flies is drawn above its shadow, in every look") {
  for (const Look look : {kMonochrome, kHalves})
    for (const View view : {View::kMap, View::kOblique, View::kFollow}) {
      Scene scene = scene_on(0.0, look, view);
      LouseMark louse;
      louse.id = 1;
      louse.is_you = true;
      louse.position = {1.0, 2.0};
      scene.lice.push_back(louse);
      const CellBuffer grounded = drawn(scene);
      scene.lice[0].above = 3.0;
      CHECK_FALSE(drawn(scene) == grounded);
    }
}

TEST_CASE("the trail of a flight is drawn where it was flown") {
  Scene scene = scene_on(0.0, kHalves, View::kOblique);
  LouseMark louse;
  louse.id = 1;
  louse.position = {5.0, 2.0};
  for (int i = 0; i < 20; ++i) louse.trail.push_back({-15.0 + i, 2.0});
  scene.lice.push_back(louse);
  const CellBuffer rolled = drawn(scene);
  scene.lice[0].trail_flights.assign(20, 0.0);
  CHECK(drawn(scene) == rolled);
  for (std::size_t i = 5; i < 15; ++i) scene.lice[0].trail_flights[i] = 4.0;
  CHECK_FALSE(drawn(scene) == rolled);
}

TEST_CASE("between a map and its walls there is no gap, on every map, at every size") {
  for (const auto& map : woodlouse::client::testing::shipped_maps()) {
    const Relief relief(map->terrain);
    const terrain::Rectangle& domain = map->terrain->domain();
    for (const int columns : {36, 47, 87})
      for (const int rows : {17, 19, 21, 34}) {
        const Size size{columns, rows};
        const MapCamera camera = camera_for(domain, size, kPixelMargin);
        const CellRange ground = camera.cells_of(domain, 2.0);
        const auto cells = top_layer(relief, camera, size, ColorMode::kTruecolor, Paint::kElevation);
        int gaps = 0;
        for (int y = std::max(0, ground.first.row); y <= std::min(2 * rows - 1, ground.last.row); ++y)
          for (int x = std::max(0, ground.first.column); x <= std::min(columns - 1, ground.last.column);
               ++x) {
            const Style& style = cells[static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(columns) +
                                       static_cast<std::size_t>(x)]
                                     .style;
            gaps +=
                (y % 2 == 0 ? style.foreground : style.background) == sky_color(1.0, ColorMode::kTruecolor)
                    ? 1
                    : 0;
          }
        INFO(map->definition.name << " " << columns << "x" << rows);
        CHECK(gaps == 0);
      }
  }
}
