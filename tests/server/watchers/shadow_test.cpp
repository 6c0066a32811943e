#include "server/watchers/shadow.h"

#include <unistd.h>
#include <string>

#include <catch2/catch.hpp>

#include <spdlog/sinks/ostream_sink.h>

#include <algorithm>
#include <filesystem>
#include <future>
#include <sstream>

#include "shared/map/map_file.h"
#include "shared/replay/source_file.h"
#include "shared/replay/verify.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

namespace fs = std::filesystem;

/// A game of two lice and its shadow; a folder for what the shadow writes.
class Stage {
 public:
  Stage() {
    fs::remove_all(folder_);
    fs::create_directory(folder_);
    for (int player = 0; player < 2; ++player) game.join();
    game.advance();
    shadow.begin(game);
  }
  ~Stage() { fs::remove_all(folder_); }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Both lice push.
  const match::StepRecord& step() {
    for (const match::PlayerId player : {1u, 2u})
      game.file({player, ++seq_, {state::ThrustKind::kMapVector, {0.5, 0.25}}, state::kHeld, 0});
    return game.advance();
  }
  void step(int times) {
    for (int k = 0; k < times; ++k) shadow.step(LiveStep(step(), {}), game);
  }
  ShadowFigures finish() {
    shadow.finish("test over", [] {});
    pool.join();
    RoomFigures figures;
    shadow.add_figures(figures);
    REQUIRE(figures.shadow);
    return *figures.shadow;
  }
  [[nodiscard]] fs::path dump(const std::string& side, std::uint64_t tick) const {
    return folder_ / ("dump." + std::to_string(tick) + "." + side + ".ndjson");
  }
  [[nodiscard]] static std::string verdict(const fs::path& file) {
    const auto result = replay::verify(replay::source_of_file(file));
    return result ? replay::to_text(*result) : result.error().text();
  }

 private:
  static std::shared_ptr<const map::Map> load() {
    auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
    REQUIRE(map);
    return *map;
  }
  fs::path folder_ = fs::temp_directory_path() / ("woodlouse_shadow_test_" + std::to_string(::getpid()));
  std::shared_ptr<const map::Map> map_ = load();
  std::uint32_t seq_ = 0;

 public:
  std::ostringstream log;
  boost::asio::thread_pool pool{1};
  match::Match game{map_, {60, 7}};
  Shadow shadow{
      "volcano",
      map_,
      replay::make_header(game, "test", "maps/volcano.json"),
      folder_ / "dump",
      pool,
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(log))};
};

}  // namespace

TEST_CASE("a game with joins, leaves, respawns and inputs filed ahead has a shadow like itself") {
  Stage stage;
  stage.step(20);
  stage.game.join();
  stage.game.respawn(1);
  stage.game.file({2, 1000, {state::ThrustKind::kAlongHeading, {1.0, 0.0}}, 7, stage.game.tick() + 40});
  stage.game.leave(1);
  for (int k = 0; k < 100; ++k) stage.shadow.step(LiveStep(stage.game.advance(), {}), stage.game);
  const ShadowFigures figures = stage.finish();
  CHECK(figures.ticks == 120);
  CHECK(figures.differences == 0);
  CHECK_FALSE(figures.ended);
  CHECK(stage.log.str().empty());
}

TEST_CASE(
    "one altered input is seen at its tick, told once with louse, field and both values, and kept in files") {
  Stage stage;
  stage.step(10);
  match::StepRecord altered = stage.step();
  altered.inputs.at(1).thrust.x = 0.25;
  stage.shadow.step(LiveStep(altered, {}), stage.game);
  stage.step(50);
  const ShadowFigures figures = stage.finish();
  CHECK(figures.ticks == 61);
  CHECK(figures.differences == 1);
  CHECK_FALSE(figures.ended);
  const std::string text = stage.log.str();
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  CHECK_THAT(text, Catch::Contains("SHADOW DIFFERS: room volcano: tick 12: hash ") &&
                       Catch::Contains("louse 2, x: ") && Catch::Contains(stage.dump("game", 12).string()) &&
                       Catch::Contains(stage.dump("shadow", 12).string()));
  // The game was played with another input than the record says: from its record the machine gives the
  // shadow's.
  CHECK_THAT(Stage::verdict(stage.dump("game", 12)),
             Catch::StartsWith("differs at tick 12: hash ") && Catch::Contains("keyframe 12: louse 2, x: "));
  CHECK(Stage::verdict(stage.dump("shadow", 12)) == "ok ticks 11 to 12, the start is taken on trust\n");
}

TEST_CASE("each difference is counted, only the first is told") {
  Stage stage;
  for (int k = 0; k < 5; ++k) {
    stage.step(3);
    match::StepRecord altered = stage.step();
    altered.hash ^= 1;
    stage.shadow.step(LiveStep(altered, {}), stage.game);
  }
  const ShadowFigures figures = stage.finish();
  CHECK(figures.ticks == 20);
  CHECK(figures.differences == 5);
  const std::string text = stage.log.str();
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
}

TEST_CASE("a shadow that falls behind is ended with one log line") {
  Stage stage;
  std::promise<void> hold;
  boost::asio::post(stage.pool, [&hold] { hold.get_future().wait(); });
  stage.step(static_cast<int>(Shadow::kMaxQueued) + 50);
  hold.set_value();
  const ShadowFigures figures = stage.finish();
  CHECK(figures.ended);
  CHECK(figures.differences == 0);
  const std::string text = stage.log.str();
  CHECK_THAT(text, Catch::Contains("SHADOW ENDED: room volcano: it fell 300 steps behind"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
}

TEST_CASE("a dump that can't be written is told in the same line, and the shadow goes on") {
  Stage stage;
  fs::remove_all(stage.dump("game", 1).parent_path());
  match::StepRecord altered = stage.step();
  altered.hash ^= 1;
  stage.shadow.step(LiveStep(altered, {}), stage.game);
  stage.step(5);
  CHECK(stage.finish().ticks == 6);
  CHECK_THAT(stage.log.str(), Catch::Contains("can't be written: No such file"));
}
