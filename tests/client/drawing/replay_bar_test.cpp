#include "client/drawing/replay_bar.h"

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "client/drawing/compose.h"
#include "client/terminal/null_screen.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

std::vector<std::string> lines_of(const Scene& scene, Size size) {
  Composer composer;
  CellBuffer cells(size);
  composer.draw(scene, cells);
  NullScreen screen;
  screen.show(cells);
  std::istringstream text(screen.text());
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// A recording of 3 minutes and 12.4 seconds, at 41.7 s.
Scene watched() {
  StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 3, 5);
  Scene scene = game.scene();
  for (LouseMark& louse : scene.lice) louse.is_you = false;
  for (ScoreRow& row : scene.scores) row.is_you = false;
  scene.spectating = true;
  scene.follow_id = 2;
  const std::vector<EventMark> marks = {{50.0, EventSign::kJoined},
                                        {50.1, EventSign::kChat},
                                        {100.0, EventSign::kLeft},
                                        {150.0, EventSign::kRespawned}};
  scene.replay = ReplayBar{
      "volcano-2031.ndjson", true, 41.7, 192.4, 1.0, std::make_shared<const std::vector<EventMark>>(marks)};
  scene.proof = StateProof{11544, 11544, 0x0123'4567'89ab'9f3a, std::nullopt};
  return scene;
}

bool holds(const std::string& line, const std::string& part) { return line.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a recording at 80x24 shows its file, its proof, its time line and its keys") {
  const auto lines = lines_of(watched(), {80, 24});
  REQUIRE(lines.size() == 24);
  CHECK(holds(lines[0], "REPLAY  volcano-2031.ndjson  3 lice"));
  CHECK(holds(lines[0], "state ok 9f3a 11544/11544"));
  CHECK(lines[22].find(" |>  00:41.7 [###") == 0);
  CHECK(holds(lines[22], "]  03:12.4   x1.0"));
  CHECK(holds(lines[22], "!"));
  CHECK_FALSE(holds(lines[22], "+"));  // the chat's sign stands in the same cell
  CHECK(holds(lines[22], "x--"));
  CHECK(holds(lines[22], "o--"));
  CHECK(holds(lines[23], "SPC pause  </> 5s ,/. tick [/] speed 0-9 jump F follow  N event  ? help  Q quit"));
}

TEST_CASE("the time line is where the recording is, from beginning to end") {
  Scene scene = watched();
  scene.replay->marks = nullptr;
  scene.replay->seconds = 0.0;
  CHECK(holds(lines_of(scene, {80, 24})[22], " 00:00.0 [|---"));
  scene.replay->seconds = scene.replay->total_seconds = 3725.0;
  scene.replay->playing = false;
  scene.replay->speed = 0.25;
  const std::string end = lines_of(scene, {80, 24})[22];
  CHECK(end.find(" ||  1:02:05.0 [###") == 0);
  CHECK(holds(end, "##]  1:02:05.0  x0.25"));
  CHECK_FALSE(holds(end, "-"));
}

TEST_CASE("a recording has its time line in colour and at the smallest size, too, and too small says so") {
  Scene scene = watched();
  scene.look = {ColorMode::kTruecolor, GlyphSet::kHalfBlocks};
  CHECK(holds(lines_of(scene, {120, 40})[38], "]  03:12.4   x1.0"));
  const auto small = lines_of(watched(), {60, 20});
  CHECK(holds(small[18], "]  03:12.4   x1.0"));
  CHECK(holds(small[0], "state ok 9f3a"));
  CHECK(holds(lines_of(watched(), {40, 10})[1], "WOODLOUSE needs 60 x 20"));
}

TEST_CASE("a state that differs is told instead of the count") {
  Scene scene = watched();
  scene.proof->differs = 701;
  CHECK(holds(lines_of(scene, {80, 24})[0], "state DIFFERS at tick 701"));
  scene = watched();
  scene.replay.reset();
  scene.proof = StateProof{12, std::nullopt, 1, std::nullopt};
  CHECK(holds(lines_of(scene, {80, 24})[0], "state ok 12 "));
}

TEST_CASE("the help of a recording tells its keys") {
  Scene scene = watched();
  scene.mode = Mode::kHelp;
  std::string all;
  for (const std::string& line : lines_of(scene, {80, 24})) all += line + "\n";
  CHECK(holds(all, "x0.25 to x16"));
  CHECK(holds(all, "Shift-F"));
  CHECK_FALSE(holds(all, "push along your heading"));
}
