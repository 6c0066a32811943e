// Your louse is in the picture: on every map, in every look, view and size, in corners, at seams and high
// above.
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "client/drawing/compose.h"
#include "client/drawing/landmarks.h"
#include "client/drawing/layout.h"
#include "client/ground/follow_camera.h"
#include "shared/core/random.h"
#include "tests/client/drawing/shipped_maps.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

/// Corners, walls, a hair inside of them, and the middle.
std::vector<core::Vec2> places(const terrain::Rectangle& d) {
  std::vector<core::Vec2> result;
  for (const double x : {0.0, 1e-12, 0.31, 0.5, 1.0 - 1e-12, 1.0})
    for (const double y : {0.0, 1e-12, 0.62, 1.0 - 1e-12, 1.0})
      result.push_back({d.x_min + (d.x_max - d.x_min) * x, d.y_min + (d.y_max - d.y_min) * y});
  return result;
}

std::vector<core::Vec2> corners_and_middles(const terrain::Rectangle& d) {
  std::vector<core::Vec2> result;
  for (const double x : {d.x_min, 0.6 * d.x_min + 0.4 * d.x_max, d.x_max})
    for (const double y : {d.y_min, 0.3 * d.y_min + 0.7 * d.y_max, d.y_max}) result.push_back({x, y});
  return result;
}

/// The map with you on it.
Scene scene_with_you(const map::Map& map, Look look, View view) {
  Scene scene = scene_of(map, look, view);
  LouseMark louse;
  louse.id = 1;
  louse.is_you = true;
  scene.lice.push_back(louse);
  return scene;
}

/// What of the map's part of the picture is not as in another one.
int differences(const CellBuffer& a, const CellBuffer& b, const Viewport& part) {
  int found = 0;
  for (int row = part.row; row < part.row + part.size.rows; ++row)
    for (int column = part.column; column < part.column + part.size.columns; ++column)
      found += a.at(column, row) == b.at(column, row) ? 0 : 1;
  return found;
}

int letters(const CellBuffer& cells, const Viewport& part) {
  int found = 0;
  for (int row = part.row; row < part.row + part.size.rows; ++row)
    for (int column = part.column; column < part.column + part.size.columns; ++column)
      found += cells.at(column, row).glyph == U'@' ? 1 : 0;
  return found;
}

constexpr Look kCharacters{ColorMode::kMono, GlyphSet::kAscii};
constexpr Look kPixels{ColorMode::kTruecolor, GlyphSet::kHalfBlocks};

}  // namespace

TEST_CASE("your louse is in every picture of a whole map, in corners, at seams and high above") {
  std::size_t number = 0;
  for (const auto& map : shipped_maps()) {
    const terrain::Rectangle& d = map->terrain->domain();
    ++number;
    for (const Size size : {Size{60, 20}, Size{120, 36}})
      for (const Look look : {kCharacters, kPixels}) {
        if (look == kPixels && (number % 4 == 0) != (size.columns == 120)) continue;  // large ones take long
        for (const View view : {View::kMap, View::kOblique, View::kSlope}) {
          Composer composer;
          Scene scene = scene_with_you(*map, look, view);
          CellBuffer empty(size);
          Scene nobody = scene;
          nobody.lice.clear();
          composer.draw(nobody, empty);
          CellBuffer cells(size);
          const Viewport part = layout_for(size, look).map;
          for (const core::Vec2 place : corners_and_middles(d))
            for (const double above : {0.0, 0.3, 9.0}) {
              scene.lice[0].position = place;
              scene.lice[0].above = above * (d.x_max - d.x_min);
              composer.draw(scene, cells);
              INFO(map->definition.name
                   << " " << size.columns << "x" << size.rows << " view " << static_cast<int>(view)
                   << " glyphs " << static_cast<int>(look.glyphs) << " at " << place.x << ", " << place.y
                   << ", above " << above);
              CHECK(differences(cells, empty, part) > 0);
              if (look == kCharacters) CHECK(letters(cells, part) == 1);
            }
        }
      }
  }
}

TEST_CASE("a following camera has your louse in every picture, wherever it is and wherever it comes from") {
  core::Random random(16);
  for (const auto& map : shipped_maps()) {
    const Relief relief(map->terrain);
    const terrain::Rectangle& d = map->terrain->domain();
    const double width = d.x_max - d.x_min;
    for (const Size size : {Size{36, 17}, Size{47, 21}, Size{87, 34}, Size{162, 58}, Size{962, 298}})
      for (const double zoom : {0.5, 1.0, 4.0}) {
        FollowCamera camera(relief, size);
        const auto check = [&](core::Vec2 at, double above) {
          INFO(map->definition.name << " " << size.columns << "x" << size.rows << " zoom " << zoom << " at "
                                    << at.x << ", " << at.y << ", above " << above);
          const Vec3 drawn{at.x, at.y, (relief.sample(at).z + above) * relief.exaggeration()};
          const auto pixel = camera.before(drawn, follow_zoom(zoom)).project(drawn);
          REQUIRE(pixel);
          CHECK(
              (pixel->x >= 0.0 && pixel->x < size.columns && pixel->y >= 0.0 && pixel->y < 2.0 * size.rows));
          for (const Margin margin : {kCharacterMargin, kPixelMargin}) {
            const Place cell = camera.over(at, follow_zoom(zoom), margin).cell_of(at, d);
            CHECK((cell.column >= 0 && cell.column < size.columns && cell.row >= 0 && cell.row < size.rows));
          }
        };
        for (const core::Vec2 place : places(d))
          for (const double above : {0.0, 0.4}) check(place, above * width);
        core::Vec2 at{d.x_min, d.y_min};  // a walk along walls and over seams
        for (int i = 0; i < 100; ++i) {
          at = {std::clamp(at.x + 0.1 * width * (random.uniform() - 0.4), d.x_min, d.x_max),
                std::clamp(at.y + 0.1 * width * (random.uniform() - 0.4), d.y_min, d.y_max)};
          check(at, i % 7 == 0 ? 0.2 * width * random.uniform() : 0.0);
        }
      }
  }
}

TEST_CASE("a louse at a wall, or a hair beyond it, leaves the picture full of map") {
  for (const auto& map : shipped_maps()) {
    const Relief relief(map->terrain);
    const terrain::Rectangle& d = map->terrain->domain();
    const Size size{47, 21};
    for (const double beyond : {0.0, 1e-9, 1e-3}) {
      FollowCamera camera(relief, size);
      camera.over({(d.x_min + d.x_max) / 2.0, (d.y_min + d.y_max) / 2.0}, 4.0, kCharacterMargin);
      const MapCamera seen = camera.over({d.x_max + beyond, d.y_max + beyond}, 4.0, kCharacterMargin);
      INFO(map->definition.name << ", " << beyond << " m beyond");
      CHECK(seen.row_of({d.x_max, d.y_max}) < 1.5);
      CHECK(seen.column_of({d.x_max, d.y_max}) > size.columns - 1.5);
    }
  }
}

TEST_CASE("a followed louse is in the picture that is drawn, in characters and in pixels") {
  for (const auto& map : shipped_maps())
    for (const Look look : {kCharacters, kPixels}) {
      Composer composer;
      Scene scene = scene_with_you(*map, look, View::kFollow);
      const terrain::Rectangle& d = map->terrain->domain();
      CellBuffer cells({60, 20});
      const Viewport part = layout_for(cells.size(), look).map;
      for (const core::Vec2 place : {core::Vec2{d.x_min, d.y_min}, core::Vec2{d.x_max, d.y_max},
                                     core::Vec2{(d.x_min + d.x_max) / 2.0, d.y_min}}) {
        scene.lice[0].position = place;
        composer.draw(scene, cells);
        CellBuffer gone(cells.size());
        Scene away = scene;
        away.lice[0].is_you = false;  // of another colour
        away.lice[0].heading = {0.0, 1.0};
        composer.draw(away, gone);
        INFO(map->definition.name << " glyphs " << static_cast<int>(look.glyphs) << " at " << place.x << ", "
                                  << place.y);
        CHECK(differences(cells, gone, part) > 0);
        if (look == kCharacters) CHECK(letters(cells, part) == 1);
      }
    }
}

TEST_CASE("a ceiling is over the ground everywhere, and near it where the ground is level") {
  core::Random random(27);
  for (const auto& map : shipped_maps()) {
    const Relief relief(map->terrain);
    const terrain::Rectangle& d = map->terrain->domain();
    int low = 0;
    constexpr int kPoints = 20000;
    for (int i = 0; i < kPoints; ++i) {
      const core::Vec2 p{d.x_min + (d.x_max - d.x_min) * random.uniform(),
                         d.y_min + (d.y_max - d.y_min) * random.uniform()};
      const double over = relief.ceiling(p) - relief.sample(p).z;
      if (over < 0.0) FAIL(map->definition.name << ": " << -over << " m above it at " << p.x << ", " << p.y);
      low += over < 0.1 * (relief.highest() - relief.lowest()) ? 1 : 0;
    }
    CHECK((relief.is_flat() || low > kPoints / 2));
  }
}

TEST_CASE("ground with peaks between the places that ceilings are made of has none") {
  core::Random random(5);
  terrain::HeightGrid peaks;
  peaks.columns = peaks.rows = 385;  // two knots a cell
  for (std::size_t j = 0; j < peaks.rows; ++j)
    for (std::size_t i = 0; i < peaks.columns; ++i)
      peaks.heights.push_back(i % 2 == 1 && j % 2 == 1 ? 20.0 : 0.0);
  const Relief relief(std::make_shared<terrain::Terrain>(terrain::BicubicSpline(peaks)));
  const terrain::Rectangle& d = relief.terrain().domain();
  for (int i = 0; i < 2000; ++i) {
    const core::Vec2 p{d.x_min + (d.x_max - d.x_min) * random.uniform(),
                       d.y_min + (d.y_max - d.y_min) * random.uniform()};
    REQUIRE(relief.ceiling(p) >= relief.sample(p).z);
  }
}
