#include "server/watchers/recorder.h"

#include <unistd.h>
#include <string>

#include <catch2/catch.hpp>

#include <spdlog/sinks/ostream_sink.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "shared/map/map_file.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/source_file.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

struct Log {
  std::ostringstream text;
  std::shared_ptr<spdlog::logger> logger =
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text));
};

/// Plays a short game into a recording, as a room does.
void play(Recorder& recorder, boost::asio::thread_pool& disk, int ticks) {
  auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
  REQUIRE(map);
  match::Match match(*map, {60, 99});
  recorder.begin(replay::make_header(match, "test", "maps/volcano.json"), match.state());
  const match::PlayerId player = match.join();
  recorder.player(player, "mara", protocol::Role::kPlayer);
  for (int tick = 0; tick < ticks; ++tick) {
    if (tick % 10 == 1)
      match.file(
          {player, static_cast<std::uint32_t>(tick), {state::ThrustKind::kAlongHeading, {0.5, 0.0}}, 5, 0});
    const match::StepRecord& step = match.advance();
    recorder.step(step, {{player, static_cast<std::uint32_t>(tick), 1000}}, match);
  }
  recorder.chat(match.tick(), player, "mara", "over \"and\" out");
  recorder.finish("test over", [] {});
  disk.join();
}

}  // namespace

TEST_CASE("a recorded game with joins, inputs, keyframes and chat verifies") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("woodlouse_recorder_test_" + std::to_string(::getpid()) + ".ndjson");
  Log log;
  boost::asio::thread_pool disk(1);
  {
    auto recorder = Recorder::open(file, disk, log.logger);
    REQUIRE(recorder);
    play(**recorder, disk, 700);
  }
  const auto result = replay::verify(replay::source_of_file(file));
  REQUIRE(result);
  CHECK(result->ok());
  CHECK_FALSE(result->cut_off);
  CHECK(result->ticks == 700);
  CHECK(log.text.str().empty());
  std::filesystem::remove(file);
}

TEST_CASE("a recording named .zst is packed and verifies") {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("woodlouse_recorder_test_" + std::to_string(::getpid()) + ".ndjson.zst");
  Log log;
  boost::asio::thread_pool disk(1);
  {
    auto recorder = Recorder::open(file, disk, log.logger);
    REQUIRE(recorder);
    play(**recorder, disk, 700);
  }
  const auto result = replay::verify(replay::source_of_file(file), 2);
  REQUIRE(result);
  CHECK(replay::to_text(*result) == "ok 700 ticks\n");
  CHECK(log.text.str().empty());
  std::filesystem::remove(file);
}

TEST_CASE("a full disk ends the recording with one log line, a word to who asked, and nothing else") {
  Log log;
  boost::asio::thread_pool disk(1);
  auto recorder = Recorder::open("/dev/full", disk, log.logger);
  REQUIRE(recorder);
  std::vector<std::string> told;
  (*recorder)->on_failure([&told](const std::string& why) { told.push_back(why); });
  play(**recorder, disk, 700);
  CHECK(told == std::vector<std::string>{"No space left on device"});
  const std::string text = log.text.str();
  CHECK_THAT(text, Catch::Contains("RECORDING ENDED") && Catch::Contains("No space left on device"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
}

TEST_CASE("a recording that cannot be created is told with the reason") {
  Log log;
  boost::asio::thread_pool disk(1);
  const auto recorder = Recorder::open("/no/such/folder/game.ndjson", disk, log.logger);
  REQUIRE_FALSE(recorder);
  CHECK_THAT(recorder.error().text(),
             Catch::Contains("/no/such/folder/game.ndjson") && Catch::Contains("No such file"));
}
