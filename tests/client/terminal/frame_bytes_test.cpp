// The budgets of a frame, counted over a minute of six moving lice with every number of the HUD new each
// frame.
#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>

#include "client/drawing/compose.h"
#include "client/terminal/cell_diff.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

double mean_bytes(terrain::FunctionName map, Look look, View view, Size size) {
  constexpr int kFrames = 60 * 30;
  StagedGame game(named_terrain(map), 6, 11);
  game.scene().look = look;
  game.scene().view = view;
  Composer composer;
  CellBuffer cells(size);
  FrameEncoder encoder(look.color);
  composer.draw(game.scene(), cells);
  encoder.encode(cells);  // the first is the whole picture
  std::size_t bytes = 0;
  for (int i = 0; i < kFrames; ++i) {
    game.advance();
    composer.draw(game.scene(), cells);
    bytes += encoder.encode(cells).size();
  }
  UNSCOPED_INFO(terrain::to_text(map)
                << ", view " << static_cast<int>(view) << ": " << bytes / kFrames << " bytes a frame");
  return static_cast<double>(bytes) / kFrames;
}

constexpr std::array kMaps = {terrain::FunctionName::kVolcano, terrain::FunctionName::kHills};
constexpr Look kAscii{ColorMode::kTruecolor, GlyphSet::kAscii};
constexpr Look kPixels{ColorMode::kTruecolor, GlyphSet::kHalfBlocks};

}  // namespace

TEST_CASE("an ASCII frame of 80x24 is half a kilobyte or less in the mean") {
  for (const auto map : kMaps)
    for (const View view : {View::kMap, View::kFollow, View::kSlope})
      CHECK(mean_bytes(map, kAscii, view, {80, 24}) < 512.0);
}

TEST_CASE("a truecolor frame of 80x24 is three kilobytes or less in the mean") {
  for (const auto map : kMaps)
    for (const View view : {View::kMap, View::kOblique, View::kFollow})
      CHECK(mean_bytes(map, kPixels, view, {80, 24}) < 3072.0);
}

TEST_CASE("a truecolor frame of 120x36 is eight kilobytes or less in the mean") {
  for (const auto map : kMaps)
    for (const View view : {View::kMap, View::kOblique, View::kFollow})
      CHECK(mean_bytes(map, kPixels, view, {120, 36}) < 8192.0);
}

TEST_CASE("a race's marks, clock and figures stay within the same bytes") {
  for (const auto& [look, size, most] :
       {std::tuple(kAscii, Size{80, 24}, 512.0), std::tuple(kPixels, Size{80, 24}, 3072.0),
        std::tuple(kPixels, Size{120, 36}, 8192.0)}) {
    StagedGame game(named_terrain(terrain::FunctionName::kHills), 6, 11);
    Scene& scene = game.scene();
    scene.look = look;
    scene.view = View::kOblique;
    for (int k = 0; k < 6; ++k)
      scene.course.gates.push_back(
          {{-12.0 + 4.0 * k, -8.0}, {-12.0 + 4.0 * k, -3.0}, std::to_string(k), k == 2, false});
    scene.course.target = core::Vec2{-4.0, -5.0};
    Composer composer;
    CellBuffer cells(size);
    FrameEncoder encoder(look.color);
    composer.draw(scene, cells);
    encoder.encode(cells);
    constexpr int kFrames = 10 * 30;
    std::size_t bytes = 0;
    for (int i = 0; i < kFrames; ++i) {
      game.advance();
      scene.course.lines = {
          {{"race", Tone::kStrong}, {"  4:" + std::to_string(59 - i / 30), Tone::kStrong}},
          {{"lap 1/3 0:0" + std::to_string(i / 30) + "." + std::to_string(100 + i * 33 % 900),
            Tone::kStrong}}};
      scene.course.splash = i % 100 < 60 ? std::optional(Splash{"-0.31", Tone::kGood}) : std::nullopt;
      scene.course.ghosts = {{"ada 1:02.345", scene.lice[2].position + core::Vec2{1.0, 1.0},
                              scene.lice[2].heading, scene.lice[2].trail}};
      composer.draw(scene, cells);
      bytes += encoder.encode(cells).size();
    }
    INFO(size.columns << " columns: " << bytes / kFrames << " bytes a frame");
    CHECK(static_cast<double>(bytes) / kFrames < most);
  }
}
