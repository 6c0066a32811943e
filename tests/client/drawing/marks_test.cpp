// What is wanted of a player is seen: the crumb that is told of, the next gate in a crowd, the way there.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "client/drawing/compose.h"
#include "client/drawing/layout.h"
#include "client/terminal/null_screen.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

constexpr Look kMarksInPixels{ColorMode::kTruecolor, GlyphSet::kHalfBlocks};

CellBuffer marks_drawn(const Scene& scene, Size size) {
  CellBuffer cells(size);
  Composer().draw(scene, cells);
  return cells;
}

std::string marks_shown(const Scene& scene, Size size = {80, 24}) {
  NullScreen screen;
  screen.show(marks_drawn(scene, size));
  const std::string text = screen.text();
  return text.substr(text.find('\n'));  // without the title
}

bool marks_show(const Scene& scene, const char* text) {
  const std::string picture = marks_shown(scene);
  UNSCOPED_INFO("\"" << text << "\" in\n" << picture);
  return picture.find(text) != std::string::npos;
}

/// Pixels of the map in the colour of what is wanted.
int goal_dots(const Scene& scene, Size size) {
  const CellBuffer cells = marks_drawn(scene, size);
  const Viewport map = layout_for(size, scene.look).map;
  const Color goal = Color::of(goal_color(scene.look));
  int count = 0;
  for (int y = 1; y < 1 + map.size.rows; ++y)
    for (int x = 0; x < map.size.columns; ++x)
      if (const Cell& cell = cells.at(x, y); cell.glyph == U'\u2580')
        count += (cell.style.foreground == goal) + (cell.style.background == goal);
  return count;
}

Scene one_louse() {
  StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 1, 4);
  Scene scene = game.scene();
  scene.lice[0].is_you = true;
  scene.lice[0].position = {0.0, 0.0};
  scene.lice[0].heading = {-0.6, 0.8};
  scene.lice[0].trail.clear();
  return scene;
}

}  // namespace

TEST_CASE("the crumb that the line tells of is told from the others without a colour, and in pixels") {
  Scene scene = one_louse();
  scene.course.crumbs = {{{4.0, -4.0}, 3}, {{-6.0, -4.0}, 1}};
  CHECK_FALSE(marks_show(scene, "[*]"));
  scene.course.crumbs[0].is_wanted = true;
  CHECK(marks_show(scene, "[*]"));
  std::swap(scene.course.crumbs[0].is_wanted, scene.course.crumbs[1].is_wanted);
  CHECK(marks_show(scene, "[o]"));
  scene.look = kMarksInPixels;
  scene.labels = false;
  for (const View view : {View::kMap, View::kOblique, View::kFollow, View::kSlope})
    for (const Size size : {Size{80, 24}, Size{120, 36}}) {
      scene.view = view;
      INFO("view " << static_cast<int>(view) << " columns " << size.columns);
      scene.course.crumbs = {{{5.0, -5.0}, 1}};
      CHECK(goal_dots(scene, size) == 0);
      scene.course.crumbs[0].is_wanted = true;
      CHECK(goal_dots(scene, size) == 12);
    }
}

TEST_CASE("in pixels the way to the goal is an arrow, in characters it is what it was") {
  Scene scene = one_louse();
  scene.course.target = core::Vec2{14.0, -14.0};
  CHECK(marks_show(scene, "SE"));
  scene.look = kMarksInPixels;
  CHECK(marks_show(scene, "\u2198"));
  CHECK_FALSE(marks_show(scene, "SE"));
  scene.course.target = core::Vec2{-14.0, 0.0};
  CHECK(marks_show(scene, "\u2190"));
  scene.look = {};
  CHECK_FALSE(marks_show(scene, "\u2190"));
}

TEST_CASE("neither names nor lice hide the next gate's posts") {
  for (const View view : {View::kMap, View::kOblique, View::kFollow})
    for (const Size size : {Size{80, 24}, Size{120, 36}, Size{200, 60}}) {
      StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 40, 4);
      Scene& scene = game.scene();
      scene.look = kMarksInPixels;
      scene.view = view;
      scene.course.gates = {{{3.0, -5.0}, {3.0, 5.0}, "1", true, false}};
      for (LouseMark& louse : scene.lice) {
        louse.position = {2.0 + 0.5 * (louse.id % 5), -6.0 + 0.3 * louse.id};
        louse.trail.clear();
        louse.is_you = louse.id == 1;
      }
      scene.lice[0].position = {-5.0, 0.0};
      INFO(size.columns << " columns, view " << static_cast<int>(view));
      CHECK(goal_dots(scene, size) >= 4);
      const std::string picture = marks_shown(scene, size);
      CHECK(picture.find("louse") != std::string::npos);
    }
}

TEST_CASE("big figures hide the next gate only where they would hide your louse else") {
  Scene scene = one_louse();
  scene.look = kMarksInPixels;
  const terrain::Rectangle& d = scene.terrain->domain();
  const double north = d.y_max - 0.12 * (d.y_max - d.y_min);
  scene.course.gates = {{{-2.0, north}, {2.0, north}, "1", true, false}};
  for (const Size size : {Size{80, 24}, Size{120, 36}}) {
    const int before = goal_dots(scene, size);
    Scene told = scene;
    told.course.splash = Splash{"-0.31", Tone::kGood};
    CHECK(goal_dots(told, size) == before);
    told.lice[0].position = {0.0, d.y_min + 0.1 * (d.y_max - d.y_min)};
    CHECK(goal_dots(told, size) < before);
  }
}

TEST_CASE("what lies over the game hides no number beside the map where there is room for it") {
  Scene scene = one_louse();
  const auto panel = [&](Size size) {
    const CellBuffer cells = marks_drawn(scene, size);
    const Viewport place = layout_for(size, scene.look).panel;
    std::u32string text;
    for (int y = 0; y < place.size.rows; ++y)
      for (int x = 0; x < place.size.columns; ++x) text += cells.at(place.column + x, place.row + y).glyph;
    return text;
  };
  for (const auto& [mode, size] :
       {std::pair{Mode::kHelp, Size{120, 36}}, std::pair{Mode::kScoreboard, Size{120, 36}},
        std::pair{Mode::kQuitQuestion, Size{120, 36}}, std::pair{Mode::kQuitQuestion, Size{80, 24}}}) {
    scene.mode = Mode::kPlay;
    const std::u32string before = panel(size);
    scene.mode = mode;
    CHECK(panel(size) == before);
  }
}

TEST_CASE("the help is of the look that is seen") {
  Scene scene = one_louse();
  const auto told = [&](Size size) {
    scene.mode = Mode::kHelp;
    return marks_shown(scene, size);
  };
  CHECK(told({80, 24}).find("@ is you, a-z others") != std::string::npos);
  CHECK(told({80, 24}).find("heads are") == std::string::npos);
  scene.look = kMarksInPixels;
  CHECK(told({80, 24}).find("Beside yours, in white, where the next push goes.") != std::string::npos);
  for (const Size size : {Size{120, 36}, Size{200, 60}}) {
    scene.view = View::kOblique;
    CHECK(told(size).find("their heads are, white or black.") != std::string::npos);
    CHECK(told(size).find("The white bar at yours: where the next push goes.") != std::string::npos);
  }
}
