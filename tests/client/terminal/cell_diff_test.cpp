#include "client/terminal/cell_diff.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <string>

#include "client/drawing/compose.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

/// Whether `bytes` hold only text, cursor moves, colours and the clear that begins a whole frame.
bool is_harmless(const std::string& bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    if (byte == 0x1b) {
      if (++i == bytes.size() || bytes[i] != '[') return false;
      do ++i;
      while (i < bytes.size() &&
             (std::isdigit(static_cast<unsigned char>(bytes[i])) != 0 || bytes[i] == ';'));
      if (i == bytes.size() || std::string("mHCJ").find(bytes[i]) == std::string::npos) return false;
    } else if (byte < 0x20 || byte == 0x7f) {
      return false;
    } else if (byte == 0xc2 && i + 1 < bytes.size() && static_cast<unsigned char>(bytes[i + 1]) < 0xa0) {
      return false;  // C1 controls
    }
  }
  return true;
}

}  // namespace

TEST_CASE("an unchanged frame is no bytes at all") {
  StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 6, 1);
  for (const ColorMode mode : {ColorMode::kMono, ColorMode::k16, ColorMode::k256, ColorMode::kTruecolor}) {
    game.scene().look = {mode, GlyphSet::kHalfBlocks};
    Composer composer;
    CellBuffer cells({80, 24});
    FrameEncoder encoder(mode);
    composer.draw(game.scene(), cells);
    CHECK_FALSE(encoder.encode(cells).empty());
    composer.draw(game.scene(), cells);
    CHECK(encoder.encode(cells).empty());
  }
}

TEST_CASE("a change the terminal cannot show costs nothing") {
  CellBuffer cells({10, 2});
  FrameEncoder encoder(ColorMode::k256);
  cells.put(3, 0, U'x', {Color::of({100, 150, 200}), {}, kPlain});
  encoder.encode(cells);
  cells.put(3, 0, U'x', {Color::of({100, 150, 201}), {}, kPlain});
  CHECK(encoder.encode(cells).empty());
  cells.put(5, 1, U' ', {Color::of({1, 2, 3}), {}, kBold});
  CHECK(encoder.encode(cells).empty());
}

TEST_CASE("one changed letter is a cursor move and the letter") {
  CellBuffer cells({80, 24});
  FrameEncoder encoder(ColorMode::kMono);
  encoder.encode(cells);
  cells.put(9, 4, U'x', {});
  CHECK(encoder.encode(cells) == "\x1b[5;10Hx");
  cells.put(10, 4, U'y', {});
  CHECK(encoder.encode(cells) == "y");
}

TEST_CASE("nothing a stranger typed reaches the terminal as a command") {
  const std::string evil =
      "\x1b]0;owned\x07\x1b[2J\r\n\t\x9b"
      "31m\xc2\x9b\x7f\xe2\x80\xae\xf0\x9f\x90\x9b";
  StagedGame game(named_terrain(terrain::FunctionName::kHills), 4, 2);
  Scene& scene = game.scene();
  scene.map_name = scene.notice = scene.chat_entry = evil;
  scene.lost = {evil, 3.0};
  for (LouseMark& louse : scene.lice) louse.name = evil;
  for (ScoreRow& row : scene.scores) row.name = evil;
  scene.chat = {{evil, evil}, {"", evil}};
  for (const GlyphSet glyphs : {GlyphSet::kAscii, GlyphSet::kHalfBlocks})
    for (const Size size : {Size{60, 20}, Size{120, 36}})
      for (const Mode mode :
           {Mode::kPlay, Mode::kHelp, Mode::kScoreboard, Mode::kChatEntry, Mode::kQuitQuestion})
        for (const View view : {View::kMap, View::kOblique}) {
          scene.look = {ColorMode::kTruecolor, glyphs};
          scene.mode = mode;
          scene.view = view;
          Composer composer;
          CellBuffer cells(size);
          composer.draw(scene, cells);
          FrameEncoder encoder(ColorMode::kTruecolor);
          const std::string bytes = encoder.encode(cells);
          CHECK(is_harmless(bytes));
          if (glyphs == GlyphSet::kAscii)
            CHECK(std::all_of(bytes.begin(), bytes.end(),
                              [](char c) { return (c >= 0x20 && c < 0x7f) || c == 0x1b; }));
        }
}
