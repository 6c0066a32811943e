#include "client/drawing/compose.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "client/cells/character_width.h"
#include "client/drawing/layout.h"
#include "client/terminal/null_screen.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

std::string text_of(const Scene& scene, Size size) {
  Composer composer;
  CellBuffer cells(size);
  composer.draw(scene, cells);
  NullScreen screen;
  screen.show(cells);
  return screen.text();
}

std::string golden(const std::string& name) {
  std::ifstream file(std::string(WOODLOUSE_SOURCE_DIR) + "/tests/client/drawing/golden/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Three lice at fixed places on the volcano.
Scene still_life() {
  Scene scene;
  scene.terrain = named_terrain(terrain::FunctionName::kVolcano);
  scene.map_name = "volcano";
  const auto add = [&](std::uint32_t id, const char* name, LouseKind kind, core::Vec2 position,
                       core::Vec2 heading) {
    LouseMark louse;
    louse.id = id;
    louse.name = name;
    louse.kind = kind;
    louse.is_you = id == 2;
    louse.position = position;
    louse.heading = louse.ahead = heading;
    for (int i = 8; i > 0; --i) louse.trail.push_back(position - (0.9 * i) * heading);
    scene.lice.push_back(louse);
    scene.scores.push_back({id, name, kind, louse.is_you, 40.0 - 7.0 * id, 2.0, static_cast<int>(id)});
  };
  add(1, "ada", LouseKind::kPlayer, {-9.0, 4.0}, {0.0, 1.0});
  add(2, "mara", LouseKind::kPlayer, {3.0, -7.0}, {1.0, 0.0});
  add(3, "gauss", LouseKind::kBot, {12.0, 11.0}, {0.6, 0.8});
  scene.chat = {{"ada", "on your tail"}, {"", "bot gauss joined"}};
  scene.hud = {2.31, -17.0, 1.0, 0.4, true, 26.0, 4.2, 0.0, 23.0, 60.0, 30.0, 3, 1, 2};
  return scene;
}

}  // namespace

TEST_CASE("the contour look at 80x24 is as it was agreed") {
  CHECK(text_of(still_life(), {80, 24}) == golden("contour_volcano_80x24.txt"));
}

TEST_CASE("the help, the scoreboard and a lost connection are as they were agreed") {
  Scene scene = still_life();
  scene.mode = Mode::kHelp;
  CHECK(text_of(scene, {80, 24}) == golden("help_80x24.txt"));
  scene.mode = Mode::kScoreboard;
  CHECK(text_of(scene, {60, 20}) == golden("scoreboard_60x20.txt"));
  scene.mode = Mode::kPlay;
  scene.lost = {"connection reset", 26.4};
  CHECK(text_of(scene, {80, 24}) == golden("connection_lost_80x24.txt"));
}

TEST_CASE("how far the steps err stands under your numbers where it is asked for, at any size") {
  Scene scene = still_life();
  CHECK(text_of(scene, {80, 24}).find("error") == std::string::npos);
  scene.hud.asks_error = true;
  CHECK(text_of(scene, {80, 24}).find("error    -- m/s") != std::string::npos);
  scene.hud.error = {15.0, 3.12e-6, 2.04e-4, 812, 1.2e-3, 10.0};
  for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}}) {
    const std::string text = text_of(scene, size);
    CHECK(text.find("error 3.1e-06 m/s") != std::string::npos);
    CHECK(text.find("worst 2.0e-04 m") != std::string::npos);
    CHECK(text.find(size.columns < 80 ? "twin  1.2e-03 m 10 s" : "twin  1.2e-03 m after 10 s") !=
          std::string::npos);
    CHECK((size.columns < 80) == (text.find("at tick 812") == std::string::npos));
    CHECK(text.find("CHAT") != std::string::npos);
    CHECK(text.find("bot gauss joined") != std::string::npos);
  }
  scene.spectating = true;  // the room's numbers are no louse's
  CHECK(text_of(scene, {80, 24}).find("error") == std::string::npos);
}

TEST_CASE("what is not known of a silent server is not shown, at any size") {
  Scene scene = still_life();
  scene.silence = 2.7;
  for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}, Size{200, 60}}) {
    const std::string text = text_of(scene, size);
    CHECK(text.find("no word for 2 s") != std::string::npos);
    CHECK(text.find("speed    -- m/s") != std::string::npos);
    CHECK(text.find("rtt --  srv --") != std::string::npos);
    CHECK(text.find("rtt 23 ms") == std::string::npos);
  }
  scene.silence.reset();
  scene.paused = true;
  CHECK(text_of(scene, {60, 20}).find("WOODLOUSE  stands still") != std::string::npos);
}

TEST_CASE("the keys that rule are those that are shown, and the help of who watches names none that drives") {
  Scene scene = still_life();
  scene.keys.up = "Z", scene.keys.quit = "F10", scene.keys.chat = "ENTER";
  CHECK(text_of(scene, {80, 24}).find("Z push S brake A/D turn") != std::string::npos);
  CHECK(text_of(scene, {80, 24}).find("CHAT  (ENTER to talk)") != std::string::npos);
  CHECK(text_of(scene, {120, 36}).find("F10 quit") != std::string::npos);
  scene.keys.compass = true;
  CHECK(text_of(scene, {60, 20}).find("ZASD push X brake") != std::string::npos);
  scene.mode = Mode::kHelp;
  CHECK(text_of(scene, {60, 20}).find("Z A S D") != std::string::npos);
  scene.spectating = true;
  CHECK(text_of(scene, {80, 24}).find("push") == std::string::npos);
}

TEST_CASE("who looks on is counted under the players, for a watcher among the room's numbers") {
  Scene scene = still_life();
  CHECK(text_of(scene, {80, 24}).find("watching") == std::string::npos);
  scene.hud.spectators = 2;
  CHECK(text_of(scene, {80, 24}).find("|   2 watching") != std::string::npos);
  CHECK(text_of(scene, {60, 20}).find("|   2 watching") != std::string::npos);
  scene.spectating = true;
  CHECK(text_of(scene, {80, 24}).find("| you and 1 more are watching") != std::string::npos);
  scene.hud.spectators = 1;
  CHECK(text_of(scene, {80, 24}).find("| you are watching") != std::string::npos);
}

TEST_CASE("a terminal that is too small is told what is needed") {
  CHECK(text_of(still_life(), {52, 14}).find("WOODLOUSE needs 60 x 20, this terminal is 52 x 14.") !=
        std::string::npos);
}

TEST_CASE("a terminal too narrow for that line is told both sizes whole, and asked before it leaves") {
  Scene scene = still_life();
  const std::string narrow = text_of(scene, {40, 12});
  CHECK(narrow.find("WOODLOUSE needs 60 x 20,") != std::string::npos);
  CHECK(narrow.find("this terminal is 40 x 12.") != std::string::npos);
  CHECK(narrow.find("Q leaves.") != std::string::npos);
  scene.mode = Mode::kQuitQuestion;
  CHECK(text_of(scene, {40, 12}).find("Leave? Y or N.") != std::string::npos);
}

TEST_CASE("every view, look, mode and size can be drawn") {
  StagedGame game(named_terrain(terrain::FunctionName::kWavyPot), 5, 4);
  Composer composer;
  for (const Size size : {Size{0, 0}, Size{1, 1}, Size{59, 20}, Size{60, 20}, Size{80, 24}, Size{300, 20},
                          Size{60, 90}, Size{200, 60}})
    for (const ColorMode color : {ColorMode::kMono, ColorMode::k16, ColorMode::k256, ColorMode::kTruecolor})
      for (const GlyphSet glyphs : {GlyphSet::kAscii, GlyphSet::kHalfBlocks})
        for (const View view : {View::kMap, View::kOblique, View::kFollow, View::kSlope}) {
          Scene& scene = game.scene();
          scene.look = {color, glyphs};
          scene.view = view;
          scene.mode = static_cast<Mode>((size.columns + static_cast<int>(view)) % 5);
          scene.spectating = size.columns == 60;
          CellBuffer cells(size);
          composer.draw(scene, cells);
          if (size.columns >= 60 && size.rows >= 20) CHECK(cells.at(1, 0).glyph == U'W');
        }
}

TEST_CASE("a scene without a map, lice, scores or chat can be drawn") {
  Scene scene;
  CHECK(text_of(scene, {80, 24}).find("waiting for the map") != std::string::npos);
  scene.terrain = named_terrain(terrain::FunctionName::kHills);
  scene.view = View::kFollow;
  scene.spectating = true;
  CHECK_FALSE(text_of(scene, {80, 24}).empty());
}

TEST_CASE("a flat map can be drawn in every view") {
  terrain::HeightGrid grid;
  grid.columns = grid.rows = 5;
  grid.heights.assign(25, 3.0);
  Scene scene = still_life();
  scene.terrain = std::make_shared<terrain::Terrain>(terrain::BicubicSpline(grid));
  for (const GlyphSet glyphs : {GlyphSet::kAscii, GlyphSet::kHalfBlocks})
    for (const View view : {View::kMap, View::kOblique, View::kFollow, View::kSlope}) {
      scene.look = {ColorMode::kTruecolor, glyphs};
      scene.view = view;
      CHECK_FALSE(text_of(scene, {100, 30}).empty());
    }
}

TEST_CASE("your louse is in reverse video and drawn over the others") {
  Scene scene = still_life();
  for (LouseMark& louse : scene.lice) louse.position = {3.0, -7.0};
  Composer composer;
  CellBuffer cells({80, 24});
  composer.draw(scene, cells);
  int found = 0;
  const Layout layout = layout_for(cells.size(), scene.look);
  for (int row = layout.map.row; row < layout.map.row + layout.map.size.rows; ++row)
    for (int column = 0; column < layout.map.size.columns; ++column)
      if (cells.at(column, row).glyph == U'@') {
        ++found;
        CHECK((cells.at(column, row).style.attributes & kReverse) != 0);
      }
  CHECK(found == 1);
}

TEST_CASE("the map and the default view follow what the terminal can do") {
  constexpr Look kPixels{ColorMode::kTruecolor, GlyphSet::kHalfBlocks};
  CHECK(default_view(kPixels, {120, 36}) == View::kOblique);
  CHECK(default_view(kPixels, {80, 24}) == View::kMap);
  // Gates lie too close together in a picture of the whole map.
  CHECK(default_view(kPixels, {120, 36}, state::Mode::kRace) == View::kFollow);
  CHECK(default_view(kPixels, {120, 36}, state::Mode::kForage) == View::kOblique);
  CHECK(default_view(kPixels, {80, 24}, state::Mode::kRace) == View::kMap);
  CHECK(default_view({ColorMode::k16, GlyphSet::kHalfBlocks}, {120, 36}) == View::kMap);
  CHECK(default_view({ColorMode::kTruecolor, GlyphSet::kAscii}, {120, 36}) == View::kMap);
}

TEST_CASE("lice at impossible places are left out") {
  const double infinity = std::numeric_limits<double>::infinity();
  Scene scene = still_life();
  scene.lice[0].position = {std::nan(""), 0.0};
  scene.lice[1].position = {1e300, -infinity};
  scene.lice[2].position = {0.0, 1e6};
  for (const Look look :
       {Look{ColorMode::kTruecolor, GlyphSet::kHalfBlocks}, Look{ColorMode::kMono, GlyphSet::kAscii}})
    for (const View view : {View::kMap, View::kOblique, View::kFollow}) {
      scene.look = look;
      scene.view = view;
      Scene empty = scene;
      empty.lice.clear();
      CHECK(text_of(scene, {100, 30}) == text_of(empty, {100, 30}));
    }
}

TEST_CASE("a name of wide characters keeps every column of the panel and of the scoreboard in its place") {
  Scene scene = still_life();
  for (const char* name :
       {"\u6F22\u5B57\u6F22\u5B57\u6F22\u5B57\u6F22\u5B57", "\uAC00\uB098 \U0001F41B", "a\u6F22e\u0301"}) {
    scene.lice[0].name = scene.scores[0].name = name;
    scene.chat = {{name, name}};
    for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}})
      for (const Mode mode : {Mode::kPlay, Mode::kScoreboard}) {
        scene.look = {ColorMode::kTruecolor, GlyphSet::kHalfBlocks};
        scene.mode = mode;
        Composer composer;
        CellBuffer cells(size);
        composer.draw(scene, cells);
        std::size_t wide = 0;
        for (int row = 0; row < size.rows; ++row)
          for (int column = 0; column < size.columns; ++column) {
            const Cell cell = whole_cell(cells.row(row), static_cast<std::size_t>(column));
            if (cell.glyph == kWideTail || columns_of(cell.glyph) != 2) continue;
            ++wide;
            CHECK(whole_cell(cells.row(row), static_cast<std::size_t>(column + 1)).glyph == kWideTail);
          }
        CHECK(wide > 0);
        // The metres end where they end beside an ASCII name.
        const std::string text = text_of(scene, size);
        CHECK(text.find("33 m") != std::string::npos);
      }
  }
}

TEST_CASE("in the narrowest terminal that line and the way out are whole words") {
  const std::string tiny = text_of(still_life(), {30, 12});
  for (const char* word :
       {"Enlarge", "zoom", "out", "(Ctrl", "and -).", "Q leaves.", "louse", "keeps", "rolling."})
    CHECK(tiny.find(word) != std::string::npos);
}

TEST_CASE("a rank of three digits is apart from the letter behind it") {
  Scene scene = still_life();
  scene.scores.front().rank = 123;
  CHECK(text_of(scene, {80, 24}).find(" 123 ") != std::string::npos);
}

TEST_CASE("in flight the panel tells how high, and what lies ahead has the louse over its ground") {
  Scene scene = still_life();
  CHECK(text_of(scene, {120, 36}).find("slope  -17 deg downhill") != std::string::npos);
  const auto row_of_louse = [&] {  // in the profile, which stands in a panel from column 87 on
    std::istringstream text(text_of(scene, {120, 36}));
    int row = 0, found = -1;
    bool is_ahead = false;
    for (std::string line; std::getline(text, line); ++row) {
      is_ahead = is_ahead || line.find("AHEAD") != std::string::npos;
      if (is_ahead && line.find('@', 87) != std::string::npos) found = row;
      if (line.find("CHAT") != std::string::npos) break;
    }
    REQUIRE(found > 0);
    return found;
  };
  const int on_ground = row_of_louse();
  scene.hud.above = scene.lice[1].above = 7.2;
  for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}}) {
    CHECK(text_of(scene, size).find("flies    7.2 m high") != std::string::npos);
    CHECK(text_of(scene, size).find("slope") == std::string::npos);
  }
  CHECK(row_of_louse() < on_ground);
  scene.hud.above = scene.lice[1].above = 300.0;
  CHECK(row_of_louse() < on_ground);
}

TEST_CASE("what lies ahead is shown where the louse goes, in all rows that there are") {
  Scene scene = still_life();
  const auto rows_of = [&](core::Vec2 ahead) {
    for (LouseMark& louse : scene.lice)
      if (louse.is_you) louse.ahead = ahead;
    const std::string picture = text_of(scene, {120, 36});
    const std::size_t title = picture.find("AHEAD");
    REQUIRE(title != std::string::npos);
    return picture.substr(title, picture.find("CHAT") - title);
  };
  const std::string east = rows_of({1.0, 0.0});
  CHECK(east != rows_of({-1.0, 0.0}));
  int rows = 0;  // with ground
  std::istringstream text(east);
  for (std::string line; std::getline(text, line);)
    rows += line.size() > 90 && line.find_first_of("#^", 88) != std::string::npos ? 1 : 0;
  INFO(east);
  CHECK(rows >= 7);
}
