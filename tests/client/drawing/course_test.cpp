// What a mode of play shows, in characters and in pixels.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "client/drawing/badges.h"
#include "client/drawing/compose.h"
#include "client/drawing/layout.h"
#include "client/terminal/null_screen.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

constexpr Look kCourseInAscii{ColorMode::kMono, GlyphSet::kAscii};
constexpr Look kCourseInHalves{ColorMode::kTruecolor, GlyphSet::kHalfBlocks};

std::string course_shown(const Scene& scene, Size size) {
  Composer composer;
  CellBuffer cells(size);
  composer.draw(scene, cells);
  NullScreen screen;
  screen.show(cells);
  return screen.text();
}

bool shows(const Scene& scene, const char* text, Size size = {80, 24}) {
  const std::string picture = course_shown(scene, size);
  UNSCOPED_INFO("\"" << text << "\" in\n" << picture);
  return picture.find(text) != std::string::npos;
}

Scene a_race() {
  StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 3, 4);
  Scene scene = game.scene();
  scene.lice[0].position = {0.0, 0.0};
  scene.course.gates = {{{-12.0, 6.0}, {-6.0, 6.0}, "S", false, false},
                        {{6.0, -9.0}, {6.0, -3.0}, "1", true, false}};
  scene.course.target = core::Vec2{6.0, -6.0};
  scene.course.lines = {
      {{"race", Tone::kStrong}, {"  4:21", Tone::kUsual}, {"  gate 1 SE 8 m", Tone::kGoal}}};
  return scene;
}

}  // namespace

TEST_CASE("the next gate is told from the others without a colour, in every view of characters") {
  for (const View view : {View::kMap, View::kOblique, View::kSlope}) {
    Scene scene = a_race();
    scene.view = view;
    CHECK(shows(scene, "[1]"));
    CHECK(shows(scene, "(S)"));
    CHECK(shows(scene, "gate 1 SE 8 m"));
    scene.course.gates.clear();
    CHECK_FALSE(shows(scene, "[1]"));
  }
}

TEST_CASE("gates, crumbs, rings and ghosts change the picture in every look and view, at every size") {
  for (const Look look : {kCourseInAscii, kCourseInHalves, Look{ColorMode::k16, GlyphSet::kAscii},
                          Look{ColorMode::k256, GlyphSet::kHalfBlocks}})
    for (const View view : {View::kMap, View::kOblique, View::kFollow, View::kSlope})
      for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}}) {
        Scene bare = a_race();
        bare.look = look;
        bare.view = view;
        bare.course = {};
        const auto picture = [&](const Scene& scene) {
          Composer composer;
          CellBuffer cells(size);
          composer.draw(scene, cells);
          return cells;
        };
        const CellBuffer before = picture(bare);
        const auto changes = [&](const auto& add) {
          Scene scene = bare;
          add(scene.course);
          return !(picture(scene) == before);
        };
        // Near the louse, that the following camera has them in its picture, and beside the other lice.
        CHECK(changes([](Course& c) { c.gates = {{{-2.0, 2.0}, {2.0, 2.0}, "3", true, false}}; }));
        CHECK(changes([](Course& c) { c.crumbs = {{{2.0, 2.0}, 1}}; }));
        CHECK(changes([](Course& c) { c.crumbs = {{{2.0, 2.0}, 3}}; }));
        CHECK(changes([](Course& c) { c.rings = {{{0.0, 0.0}, 3.0, RingMark::State::kFree, 0}}; }));
        CHECK(changes([](Course& c) { c.ghosts = {{"ada", {2.0, 2.0}, {1.0, 0.0}, {}}}; }));
        CHECK(changes([](Course& c) { c.splash = Splash{"-0.31", Tone::kGood}; }));
        CHECK(changes([](Course& c) { c.podium = {{1, "ada", false, "12", "GOLD"}}; }));
      }
}

TEST_CASE("impossible places of marks are left out") {
  for (const Look look : {kCourseInAscii, kCourseInHalves})
    for (const View view : {View::kMap, View::kOblique, View::kFollow}) {
      Scene scene = a_race();
      scene.look = look;
      scene.view = view;
      const double infinity = std::numeric_limits<double>::infinity();
      for (const core::Vec2 place :
           {core::Vec2{std::nan(""), 0.0}, core::Vec2{infinity, -infinity}, core::Vec2{1e300, 1e9}}) {
        scene.course.gates.push_back({place, {0.0, 0.0}, "9", true, false});
        scene.course.crumbs.push_back({place, 3});
        scene.course.rings.push_back({place, 1e300, RingMark::State::kContested, 0});
        scene.course.ghosts.push_back({"x", place, {0.0, 0.0}, {place}});
        scene.course.target = place;
        CHECK_FALSE(course_shown(scene, {100, 30}).empty());
      }
    }
}

TEST_CASE("what is out of the picture is pointed at from its edge, with the metres") {
  Scene scene = a_race();
  scene.view = View::kFollow;
  scene.zoom = 2.0;
  scene.course.target = core::Vec2{18.0, 0.0};
  CHECK(shows(scene, "18 m >"));
  scene.course.target = core::Vec2{0.0, -18.0};
  CHECK(shows(scene, "v 18 m"));
}

TEST_CASE("big figures say a split with its sign where there is no colour") {
  Scene scene = a_race();
  scene.course.splash = Splash{"-0.31", Tone::kGood};
  CHECK(shows(scene, "### # #    ###  # "));  // their middle
}

TEST_CASE("whoever holds the place, yours is the only @ in a picture of characters") {
  for (const RingMark::State state :
       {RingMark::State::kFree, RingMark::State::kHeld, RingMark::State::kContested})
    for (const std::uint32_t holder : {0u, 1u, 2u}) {
      Scene scene = a_race();
      scene.course = {};
      scene.course.rings.push_back({{2.0, 2.0}, 3.0, state, holder});
      CellBuffer cells({80, 24});
      Composer().draw(scene, cells);
      const Viewport map = layout_for(cells.size(), scene.look).map;
      int letters = 0;
      for (int y = 1; y < 1 + map.size.rows; ++y)
        for (int x = 0; x < map.size.columns; ++x) letters += cells.at(x, y).glyph == U'@' ? 1 : 0;
      CHECK(letters == 1);
    }
}

TEST_CASE("a ghost that waits in a gate does not hide its posts") {
  for (const Look look : {kCourseInAscii, kCourseInHalves}) {
    Scene scene = a_race();
    scene.look = look;
    const auto posts = [&] {
      CellBuffer cells({80, 24});
      Composer().draw(scene, cells);
      const Viewport map = layout_for(cells.size(), look).map;
      const Color goal = Color::of(goal_color(look));
      int count = 0;
      for (int y = 1; y < 1 + map.size.rows; ++y)
        for (int x = 0; x < map.size.columns; ++x) {
          const Cell& cell = cells.at(x, y);
          count += look == kCourseInAscii ? cell.glyph == U'#'
                                          : (cell.style.foreground == goal) + (cell.style.background == goal);
        }
      return count;
    };
    scene.labels = false;
    scene.course.target.reset();
    const int before = posts();
    for (const double y : {-9.0, -8.0, -6.0, -3.0})
      scene.course.ghosts.push_back({"x", {6.0, y}, {0.0, 1.0}, {}});
    CHECK(before > 1);
    CHECK(posts() == before);
  }
}

TEST_CASE("big figures hide your louse at no place, in no view") {
  for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}})
    for (const View view : {View::kMap, View::kFollow, View::kSlope}) {
      Scene scene = a_race();
      scene.view = view;
      scene.course.splash = Splash{"0:12.34", Tone::kGood};
      for (LouseMark& louse : scene.lice) louse.trail.clear();
      const terrain::Rectangle& d = scene.terrain->domain();
      for (int i = 1; i < 40; ++i) {
        scene.lice[0].position = {0.03 * i, d.y_min + (d.y_max - d.y_min) * i / 40.0};
        CellBuffer cells(size);
        Composer().draw(scene, cells);
        const Viewport map = layout_for(size, scene.look).map;
        int letters = 0;
        for (int y = 1; y < 1 + map.size.rows; ++y)
          for (int x = 0; x < map.size.columns; ++x) letters += cells.at(x, y).glyph == U'@' ? 1 : 0;
        INFO(size.columns << "x" << size.rows << " view " << static_cast<int>(view) << " step " << i);
        CHECK(letters == 1);
      }
    }
}

TEST_CASE("a podium names the best three, you among them, with medals") {
  Scene scene = a_race();
  scene.course.podium = {{2, "ada", false, "1:02.345", "GOLD"},
                         {1, "mara", true, "1:10.000", ""},
                         {3, "lin", false, "1:12.000", "BRONZE"}};
  scene.course.podium_note = "you: 1:10.000, #2";
  for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}})
    for (const char* text : {"ada", "you", "lin", "GOLD", "you: 1:10.000, #2"})
      CHECK(shows(scene, text, size));
}

TEST_CASE("no letter is given twice, and behind the letters there is a sign that is none") {
  Scene scene;
  for (std::uint32_t id = 1; id <= 70; ++id) {
    LouseMark louse;
    louse.id = id;
    louse.is_you = id == 30;
    scene.lice.push_back(louse);
  }
  const Badges badges(scene);
  std::multiset<char> letters;
  for (const LouseMark& louse : scene.lice) letters.insert(badges.of(louse.id).letter);
  CHECK(letters.count('@') == 1);
  CHECK(letters.count('+') == 70 - 1 - 52);
  for (const char first : {'a', 'A'})
    for (int k = 0; k < 26; ++k) CHECK(letters.count(static_cast<char>(first + k)) == 1);
}

TEST_CASE("no two of 28 lice have one colour and one coat, and a louse keeps its own") {
  Scene scene;
  scene.look = kCourseInHalves;
  for (std::uint32_t id = 3; id <= 60; id += 2) {
    LouseMark louse;
    louse.id = id;
    louse.is_you = id == 59;
    scene.lice.push_back(louse);
  }
  REQUIRE(scene.lice.size() == 29);
  const Badges badges(scene);
  std::set<std::array<int, 4>> seen;
  for (const LouseMark& louse : scene.lice) {
    const Badge badge = badges.of(louse.id);
    seen.insert({badge.color.r, badge.color.g, badge.color.b, static_cast<int>(badge.coat)});
  }
  CHECK(seen.size() == 29);
  const Badge before = badges.of(5);
  scene.lice.erase(scene.lice.begin());
  CHECK(Badges(scene).of(5).color == before.color);
  CHECK(Badges(scene).of(5).coat == before.coat);
  // Coats show in the body: at the head, or behind it.
  Badge badge{'a', {255, 205, 84}};
  std::set<std::array<int, 2>> coats;
  for (std::size_t k = 0; k < kCoats; ++k) {
    badge.coat = static_cast<Coat>(k);
    coats.insert({body_color(badge, 0.8).r, body_color(badge, -0.2).r});
    CHECK(body_color(badge, 0.2) == badge.color);
  }
  CHECK(coats.size() == kCoats);
}

TEST_CASE("your own row stays in panel and scoreboard, with its rank, whoever is before you") {
  StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 60, 4);
  Scene& scene = game.scene();
  for (std::size_t i = 0; i < scene.scores.size(); ++i) {
    scene.scores[i].is_you = i + 1 == scene.scores.size();
    scene.scores[i].rank = static_cast<int>(i) + 1;
  }
  CHECK(shows(scene, "60 + you"));
  scene.mode = Mode::kScoreboard;
  CHECK(shows(scene, "60  + you", {60, 20}));
}

TEST_CASE("your name is shown in the densest crowd") {
  StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 80, 4);
  Scene& scene = game.scene();
  scene.look = kCourseInHalves;
  for (LouseMark& louse : scene.lice) louse.position = {0.05 * (louse.id % 9), 0.05 * (louse.id % 7)};
  for (const View view : {View::kMap, View::kOblique}) {
    scene.view = view;
    const std::string picture = course_shown(scene, {120, 36});
    std::size_t on_map = 0;  // besides the panel's
    for (std::size_t at = picture.find("you"); at != std::string::npos; at = picture.find("you", at + 1))
      ++on_map;
    CHECK(on_map >= 2);
  }
}

TEST_CASE("a part of a line that does not fit is left out, never cut") {
  Scene scene = a_race();
  scene.course.lines = {
      {{"race", Tone::kStrong}, {"  next round in 0:06"}, {"  round 1 is over", Tone::kDim, true}},
      {{"lap 2/3 "}, {"0:10.000"}, {"  #2/5", Tone::kUsual, true}, {"  bronze 1:32.47"}}};
  CHECK(shows(scene, " race  next round in 0:06  round 1 is over ", {80, 24}));
  CHECK(shows(scene, " lap 2/3 0:10.000  #2/5  bronze 1:32.47 ", {80, 24}));
  CHECK(shows(scene, " race  next round in 0:06           ", {60, 20}));
  CHECK(shows(scene, " lap 2/3 0:10.000  bronze 1:32.47 ", {60, 20}));
  scene.course.lines = {{{"what is far too long for the line that it is put in and still goes on"}}};
  CHECK(shows(scene, " what is far too long for the line ", {60, 20}));
  scene.course.lines.clear();
  scene.course.lesson = {{{"W A S D push that way"}, {"  Esc: no lesson"}}};
  CHECK(shows(scene, "  Esc: no lesson ", {60, 20}));
}

TEST_CASE("lines hide nothing of the map") {
  for (const Size size : {Size{60, 20}, Size{80, 24}, Size{120, 36}}) {
    Scene scene = a_race();
    scene.course = {};
    const auto signs = [&](char32_t sign, int rows_above, int rows_below) {
      CellBuffer cells(size);
      Composer().draw(scene, cells);
      const Viewport map = layout_for(size, scene.look).map;
      int count = 0;
      for (int y = 1 + rows_above; y < 1 + map.size.rows - rows_below; ++y)
        for (int x = 0; x < map.size.columns; ++x) count += cells.at(x, y).glyph == sign ? 1 : 0;
      return count;
    };
    for (LouseMark& louse : scene.lice) louse.trail.clear();
    scene.lice[0].position = {0.0, scene.terrain->domain().y_max};  // where the lines used to be
    scene.lice[1].position = {0.0, scene.terrain->domain().y_min};
    REQUIRE(signs(U'@', 0, 0) == 1);
    scene.course.lines = a_race().course.lines;
    scene.course.lesson = {{{"1/3 PUSH"}}, {{"how"}}};
    for (const View view : {View::kMap, View::kSlope, View::kFollow}) {
      scene.view = view;
      CHECK(signs(U'@', 2, 2) == 1);
    }
  }
}
