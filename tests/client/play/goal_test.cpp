#include "client/play/modes/goal.h"

#include <catch2/catch.hpp>
#include <tuple>

#include "client/drawing/compose.h"
#include "client/play/modes/course_builder.h"
#include "client/play/modes/ruling_words.h"
#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"
#include "shared/rules/climb.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

constexpr std::int64_t kSecond = 60 * 65536;  // in moments at 60 Hz

std::shared_ptr<const map::Map> shipped_map(const char* name) {
  const auto file = map::find_map(name);
  REQUIRE(file);
  auto map = map::load_map(*file);
  REQUIRE(map);
  return std::move(*map);
}

/// Lice of a mode as a client sees them.
struct SeenRoom {
  std::shared_ptr<const map::Map> map;
  std::map<std::uint32_t, Present> lice;
  std::map<std::uint32_t, Trail> trails;
  protocol::Game game;
  state::Mode mode;

  void add(std::uint32_t id, std::int64_t score, double distance, bool is_you = false) {
    Present louse;
    louse.name = "louse" + std::to_string(id);
    louse.is_you = is_you;
    louse.sample.distance = distance;
    louse.sample.standing.score = score;
    lice[id] = louse;
  }
  [[nodiscard]] Sight sight() const {
    Sight sight{map.get(), lice, trails};
    sight.ruling = {mode, &game, 6000.0, 60, 60'000};
    sight.name_of = [](std::uint32_t id) { return "louse" + std::to_string(id); };
    return sight;
  }
};

SeenRoom race() {
  SeenRoom room{shipped_map("crater_loop"), {}, {}, {}, state::Mode::kRace};
  room.game.phase = protocol::GamePhase::kPlay;
  room.game.until = 12'000;
  room.game.round = 2;
  return room;
}

std::string text_of(const std::vector<GoalLine>& lines) {
  std::string text;
  for (const GoalLine& line : lines) text += plain_text(line) + "\n";
  return text;
}

}  // namespace

TEST_CASE("a race ranks by the best run, whoever has none comes last and has no rank") {
  SeenRoom room = race();
  room.add(1, 0, 900.0);
  room.add(2, 70 * kSecond, 10.0, true);
  room.add(3, 65 * kSecond, 20.0);
  const auto rows = score_rows(room.sight());
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].id == 3);
  CHECK(rows[0].measure == "1:05.000");
  CHECK(rows[1].rank == 2);
  CHECK(rows[2].id == 1);
  CHECK(rows[2].rank == 0);
  CHECK(rows[2].measure == "--");
}

TEST_CASE("forage and hill rank by points and held seconds, not by metres") {
  SeenRoom room = race();
  room.mode = state::Mode::kForage;
  room.add(1, 3, 900.0);
  room.add(2, 12, 10.0);
  CHECK(score_rows(room.sight())[0].id == 2);
  CHECK(score_rows(room.sight())[0].measure == "12");
  room.mode = state::Mode::kHill;
  room.map = shipped_map("table");
  room.add(2, 15 * 60, 10.0);
  const auto rows = score_rows(room.sight());
  CHECK(rows[0].measure == "15.0 s");
  CHECK(rows[0].share == Approx(0.5));  // of the 30 s that win
}

TEST_CASE("of a part of the room the table is shown, and oneself without a rank that nobody knows") {
  SeenRoom room = race();
  room.add(7, 0, 5.0, true);
  room.game.table = {{41, 60 * kSecond}, {42, 61 * kSecond}};
  Sight sight = room.sight();
  sight.is_part = true;
  const auto rows = score_rows(sight);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].name == "louse41");
  CHECK(rows[1].rank == 2);
  CHECK(rows[2].is_you);
  CHECK(rows[2].rank == 0);
  sight.ruling.game = nullptr;  // roam: of whom one sees nobody knows the rank
  CHECK(score_rows(sight)[0].rank == 0);
}

TEST_CASE("a race's lines say the way to the next gate, the clock and the medal to win") {
  SeenRoom room = race();
  room.add(2, 0, 10.0, true);
  LouseSample& you = room.lice.at(2).sample;
  you.standing.gate = 3;
  you.standing.lap = 1;
  you.standing.lap_start = 5400 * 65536LL;
  const Sight sight = room.sight();
  const std::string text = text_of(goal_lines({sight, 2, &you, true, nullptr, 2}));
  CHECK(text.find("race  1:40 left  gate 3: west ") != std::string::npos);
  CHECK(text.find(" from ") == std::string::npos);
  const std::string watched = text_of(goal_lines({sight, 2, &you, false, nullptr, 2}));
  CHECK(watched.find(" m from louse2\nlouse2: lap 2/3") != std::string::npos);
  CHECK(text.find("lap 2/3 run 0:10.000  #2/1  bronze 1:30.00") != std::string::npos);
  const Course course = course_of({sight, 2, &you, true, nullptr, 2});
  REQUIRE(course.gates.size() == 6);
  CHECK(course.gates[3].is_next);
  CHECK(course.gates[0].label == "S");
  REQUIRE(course.target);
}

TEST_CASE("a hill's lines say where the place is, when it moves, and who holds it") {
  SeenRoom room = race();
  room.mode = state::Mode::kHill;
  room.map = shipped_map("table");
  room.game.hill = protocol::GameHill{0, 9, false, 6000 + 44 * 60};
  room.add(2, 60, 10.0, true);
  room.lice.at(2).sample.position = {0.0, 10.0};
  const Sight sight = room.sight();
  const LouseSample& you = room.lice.at(2).sample;
  const auto lines = goal_lines({sight, 2, &you, true, nullptr, 1});
  const std::string text = text_of(lines);
  CHECK(text.find("hill  place south 10 m  moves in 44s  1:40 left\n") == 0);
  std::string narrow;  // what stays beside a panel of 24
  for (const GoalSpan& span : lines[0]) narrow += span.is_extra ? "" : span.text;
  CHECK(narrow == "hill south 10 m  moves in 44s");
  CHECK(text.find("held 1.0 s of 30 s  louse9 holds it") != std::string::npos);
  CHECK(course_of({sight, 2, &you, true, nullptr, 1}).rings.size() == 1);
  room.game.hill->moves_at = 6000 + 10 * 60;  // soon: the next one is shown, too
  CHECK(course_of({sight, 2, &you, true, nullptr, 1}).rings.size() == 2);
  const std::string out = text_of(goal_lines({sight, 2, nullptr, true, nullptr, 0}));
  CHECK(out.find("out: back at a spawn soon") != std::string::npos);
}

TEST_CASE("of the crumbs that are shown one is wanted: the one that the line tells of") {
  SeenRoom room{shipped_map("picnic"), {}, {}, {}, state::Mode::kForage};
  room.game.phase = protocol::GamePhase::kPlay;
  room.add(2, 0, 10.0, true);
  const LouseSample& you = room.lice.at(2).sample;
  room.game.crumbs = {{0, {1.0, 0.0}, 1}, {1, {9.0, 0.0}, 3}, {2, {7.0, 0.0}, 3}, {3, {0.0, 1.0}, 0}};
  const Course course = course_of({room.sight(), 2, &you, true, nullptr, 1});
  REQUIRE(course.crumbs.size() == 3);
  for (const CrumbMark& crumb : course.crumbs) CHECK(crumb.is_wanted == (crumb.position.x == 7.0));
  CHECK(text_of(course.lines).find("crumb worth 3: east 7 m") != std::string::npos);
  room.game.phase = protocol::GamePhase::kPodium;
  CHECK_FALSE(course_of({room.sight(), 2, &you, true, nullptr, 1}).crumbs[2].is_wanted);
}

TEST_CASE("medals are the author's time, and 6, 20 and 50 percent more") {
  const auto medal = [](double seconds) {
    return medal_of(60'000, static_cast<std::int64_t>(seconds * kSecond), 60);
  };
  CHECK(medal(60.0) == "AUTHOR");
  CHECK(medal(60.01) == "GOLD");
  CHECK(medal(63.6) == "GOLD");
  CHECK(medal(63.7) == "SILVER");
  CHECK(medal(90.0) == "BRONZE");
  CHECK(medal(90.1).empty());
  CHECK(medal_of(0, kSecond, 60).empty());
}

TEST_CASE("a welcome's rules tell the author's time, or nothing") {
  CHECK(author_ms_of(R"({"laps":3,"author_ms":61652})") == 61652);
  for (const char* text : {"", "{", "[]", R"({"author_ms":-1})", R"({"author_ms":"1"})", R"({"laps":3})"})
    CHECK(author_ms_of(text) == 0);
}

TEST_CASE("a way is named by the keys that push there, in a picture that is turned, too") {
  const core::Vec2 turned = up_in_picture(View::kOblique, Look{ColorMode::kTruecolor, GlyphSet::kHalfBlocks});
  REQUIRE(turned.x > 0.0);  // its up is east of north
  const core::Vec2 north{0.0, 1.0};
  CHECK(compass(turned, turned) == "north");
  CHECK(compass({turned.y, -turned.x}, turned) == "east");
  const core::Vec2 between{-0.2, 1.0};  // 11 degrees west of north: 28 left of up
  CHECK(compass(between, north) == "north");
  CHECK(compass(between, turned) == "NW");
  CHECK(way_text({0.0, 0.4}, north) == "here");
  CHECK(way_text({0.0, -10.0}, north) == "south 10 m");
  CHECK(way_text({3.0, -3.0}, north) == "SE 4 m");
  CHECK(way_text({3.0, -3.0}, north, Winds::kSpoken) == "south-east 4 m");

  SeenRoom room = race();
  room.add(2, 0, 10.0, true);
  LouseSample& you = room.lice.at(2).sample;
  you.standing.gate = 1;
  const map::Gate& gate = room.map->definition.modes.race->gates[1];
  you.position = 0.5 * (gate.a + gate.b) - 20.0 * between;
  CHECK(text_of(goal_lines({room.sight(), 2, &you, true, nullptr, 1})).find("gate 1: north 20 m") !=
        std::string::npos);
  CHECK(text_of(goal_lines({room.sight(), 2, &you, true, nullptr, 1, turned})).find("gate 1: NW 20 m") !=
        std::string::npos);
}

TEST_CASE("the gate where laps begin has the same name in the chat as in the picture") {
  const SeenRoom room = race();
  const Sight sight = room.sight();
  protocol::Event event;
  event.kind = protocol::EventKind::kGate;
  event.id = 7;
  event.values = {0, 1, 12 * kSecond, std::nullopt};
  CHECK(describe_ruling(event, 7, 60, sight) == "gate S 0:12.000");
  event.values = {3, 1, 12 * kSecond, -kSecond / 2};
  CHECK(describe_ruling(event, 7, 60, sight) == "gate 3 0:12.000 -0.50 s");
  CHECK(describe_ruling(event, 8, 60, sight).empty());
  event.values = {0, 0, 0, std::nullopt};
  CHECK(describe_ruling(event, 7, 60, sight) == "through S: the clock runs");
}

TEST_CASE("who fell is told with who pushed it, and what that brought") {
  SeenRoom room = race();
  room.mode = state::Mode::kHill;
  protocol::Event event;
  event.kind = protocol::EventKind::kFell;
  event.id = 7;
  event.name = "gauss";
  const auto told = [&](std::int64_t by, std::uint32_t you) {
    event.values[0] = by;
    return describe_ruling(event, you, 60, room.sight());
  };
  CHECK(told(0, 2) == "gauss fell off");
  CHECK(told(0, 7) == "you fell off");
  CHECK(told(2, 2) == "you pushed gauss off: +3 s");
  CHECK(told(3, 2) == "louse3 pushed gauss off: +3 s");
  CHECK(told(3, 7) == "louse3 pushed you off: +3 s");
  room.game.phase = protocol::GamePhase::kCountdown;  // nothing counts
  CHECK(told(2, 2) == "you pushed gauss off");
}

TEST_CASE("who is out stays in the table of a hill, and says so") {
  SeenRoom room = race();
  room.mode = state::Mode::kHill;
  room.map = shipped_map("table");
  room.add(2, 60, 10.0, true);
  room.add(3, 30, 90.0);
  room.game.table = {{5, 120}, {2, 60}, {3, 30}};
  Sight sight = room.sight();
  sight.is_bot = [](std::uint32_t id) { return id == 5; };
  const auto rows = score_rows(sight);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].name == "louse5");
  CHECK(rows[0].measure == "out");
  CHECK(rows[0].kind == LouseKind::kBot);
  CHECK(rows[0].rank == 1);
  CHECK(rows[0].share == 120.0 / (30 * 60));
  CHECK(rows[1].is_you);
  CHECK(rows[1].measure == "1.0 s");
}

TEST_CASE("a way that is too steep for a push is said to need a run-up") {
  SeenRoom room{shipped_map("picnic"), {}, {}, {}, state::Mode::kForage};
  room.game.phase = protocol::GamePhase::kPlay;
  room.game.until = 12'000;
  room.add(2, 0, 10.0, true);
  LouseSample& you = room.lice.at(2).sample;
  const double climbs = rules::climbable_slope(room.map->definition.physics);
  const terrain::Rectangle& domain = room.map->terrain->domain();
  int steep = 0, gentle = 0;
  for (double x = domain.x_min + 5.0; x < domain.x_max - 6.0; x += 3.0) {
    you.position = {x, 0.5 * (domain.y_min + domain.y_max)};
    room.game.crumbs = {{0, you.position + core::Vec2{1.0, 0.0}, 1}};
    double most = -1.0;
    for (int k = 0; k <= 100; ++k)
      most = std::max(most, room.map->terrain->sample(x + 0.01 * k, you.position.y).zx);
    if (std::abs(most - climbs) < 0.02) continue;
    const std::string text = text_of(goal_lines({room.sight(), 2, &you, true, nullptr, 1}));
    CHECK((text.find("needs a run-up") != std::string::npos) == (most > climbs));
    ++(most > climbs ? steep : gentle);
  }
  CHECK(gentle > 0);
  CHECK(steep > 0);
}

TEST_CASE("a split is told in figures with its sign, for two seconds") {
  OwnRun run;
  const core::Time now{std::chrono::seconds(100)};
  protocol::Event event;
  event.kind = protocol::EventKind::kGate;
  event.id = 7;
  event.values = {2, 0, 12 * kSecond, -kSecond / 4};
  run.event(event, 8, 60, now);
  CHECK_FALSE(run.splash(now));  // somebody else's
  run.event(event, 7, 60, now);
  REQUIRE(run.splash(now));
  CHECK(run.splash(now)->text == "-0.25");
  CHECK(run.splash(now)->tone == Tone::kGood);
  event.values[3] = kSecond / 2;
  run.event(event, 7, 60, now);
  CHECK(run.splash(now)->text == "+0.50");
  CHECK_FALSE(run.splash(now + OwnRun::kSplashFor));
}

TEST_CASE("a chain runs out in four seconds") {
  OwnRun run;
  protocol::Event event;
  event.kind = protocol::EventKind::kCrumb;
  event.id = 7;
  event.moment = 600 * 65536;
  event.values = {3, 1, 2, 5};
  run.event(event, 7, 60, {});
  CHECK(run.chain(600.0, 60) == 2);
  CHECK(run.chain_left(720.0, 60) == Approx(0.5));
  CHECK(run.chain(841.0, 60) == 0);
}

TEST_CASE("a time is a time on either side of nought") {
  CHECK(span_text(62 * kSecond + kSecond / 2, 60) == "1:02.500");
  CHECK(span_text(-kSecond / 2, 60) == "-0:00.500");
  CHECK(span_text(-62 * kSecond, 60) == "-1:02.000");
}

TEST_CASE("the help has a few words of what is played, short enough for its box") {
  SeenRoom room = race();
  room.add(1, 0, 1.0, true);
  for (const auto& [mode, name, word] :
       {std::tuple{state::Mode::kRace, "crater_loop", "3 laps"},
        std::tuple{state::Mode::kForage, "picnic", "crumbs"},
        std::tuple{state::Mode::kHill, "table", "30 s wins. Bump others off"}}) {
    room.mode = mode;
    room.map = shipped_map(name);
    const Sight sight = room.sight();
    const auto rules = course_of({sight, 1, nullptr, true, nullptr, 0}).rules;
    REQUIRE(rules.size() == 2);
    for (const std::string& line : rules) CHECK(line.size() <= 50);
    CHECK((rules[0] + " " + rules[1]).find(word) != std::string::npos);
  }
}
