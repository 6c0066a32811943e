// The budgets of a frame, counted over a minute of six moving lice with every number of the HUD new each
// frame.
#include <array>
#include <catch2/catch.hpp>
#include <cstddef>

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
    for (const View view : {View::kOblique, View::kFollow})
      CHECK(mean_bytes(map, kPixels, view, {120, 36}) < 8192.0);
}
