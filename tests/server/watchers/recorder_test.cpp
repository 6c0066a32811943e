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

std::unique_ptr<match::Match> new_match() {
  auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
  REQUIRE(map);
  return std::make_unique<match::Match>(*map, match::MatchSettings{60, 99});
}

replay::Header header() { return replay::make_header(*new_match(), "test", "maps/volcano.json"); }

core::Expected<std::unique_ptr<Recorder>> open(const std::string& file, const Log& log) {
  const auto pattern = RecordPattern::parse(file, 1);
  REQUIRE(pattern);
  return Recorder::open(std::make_shared<RecordingFiles>(*pattern), "volcano", header(), {}, log.logger);
}

/// Plays a short game into a recording, as a room does. What it announces is kept.
std::vector<protocol::Notice> play(Recorder& recorder, int ticks, int chats = 1) {
  std::vector<protocol::Notice> announced;
  const auto game = new_match();
  match::Match& match = *game;
  recorder.attach([&announced](const protocol::Notice& notice) { announced.push_back(notice); });
  recorder.begin(match);
  const match::PlayerId player = match.join({"mara", state::Role::kPlayer});
  for (int tick = 0; tick < ticks; ++tick) {
    if (tick % 10 == 1)
      match.file(
          {player, static_cast<std::uint32_t>(tick), {state::ThrustKind::kAlongHeading, {0.5, 0.0}}, 5, 0});
    const match::StepRecord& step = match.advance();
    const InputMargin margin{player, static_cast<std::uint32_t>(tick), 1000};
    recorder.step(LiveStep(step, {&margin, 1}), match);
  }
  for (int k = 1; k < chats; ++k) recorder.chat(match.tick(), player, "mara", std::string(4000, 'x'));
  recorder.chat(match.tick(), player, "mara", "over \"and\" out");
  recorder.finish("test over", [] {});
  REQUIRE(recorder.thread()->wait_until(Clock::now() + std::chrono::seconds(60)));
  return announced;
}

}  // namespace

TEST_CASE("a recorded game with joins, inputs, keyframes and chat verifies") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("woodlouse_recorder_test_" + std::to_string(::getpid()) + ".ndjson");
  Log log;
  {
    auto recorder = open(file.string(), log);
    REQUIRE(recorder);
    play(**recorder, 700);
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
  {
    auto recorder = open(file.string(), log);
    REQUIRE(recorder);
    play(**recorder, 700);
  }
  const auto result = replay::verify(replay::source_of_file(file), 2);
  REQUIRE(result);
  CHECK(replay::to_text(*result) == "ok ticks 0 to 700\n");
  CHECK(log.text.str().empty());
  std::filesystem::remove(file);
}

TEST_CASE("a full disk ends the recording with one log line, a word to who asked, and nothing else") {
  Log log;
  auto recorder = open("/dev/full", log);
  REQUIRE(recorder);
  const std::vector<protocol::Notice> told = play(**recorder, 700);
  REQUIRE(told.size() == 1);
  CHECK(told[0] ==
        protocol::Notice{"recording_ended", "the game is no longer recorded: No space left on device"});
  const std::string text = log.text.str();
  CHECK_THAT(text, Catch::Contains("RECORDING ENDED") && Catch::Contains("No space left on device"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
}

namespace {

/// Keeps what it gets, and fails at the call it is told to: writes from 1, and the closing.
class FailingSink final : public core::ByteSink {
 public:
  FailingSink(std::string& kept, int failing_write, bool fails_to_close)
      : kept_(kept), left_(failing_write), fails_to_close_(fails_to_close) {}
  core::Expected<void> write(std::string_view bytes) override {
    if (--left_ == 0) return core::fail("sink", "the disk is gone");
    kept_ += bytes;
    return {};
  }
  core::Expected<void> close() override {
    if (fails_to_close_) return core::fail("sink", "the disk is gone at last");
    return {};
  }

 private:
  std::string& kept_;
  int left_;
  bool fails_to_close_;
};

}  // namespace

TEST_CASE("a recording whose sink fails at any call is given up once, and what was written before stands") {
  for (const int failing_write : {0, 1, 2}) {
    Log log;
    std::string kept;
    const bool fails_to_close = failing_write == 0;
    Recorder recorder(std::make_unique<FailingSink>(kept, failing_write, fails_to_close), "game.ndjson",
                      header(), log.logger);
    // So much that it is written in several parts.
    const std::vector<protocol::Notice> told = play(recorder, 300, 200);
    INFO("write " << failing_write);
    REQUIRE(told.size() == 1);
    CHECK_THAT(told[0].text, Catch::Contains("the disk is gone"));
    const std::string text = log.text.str();
    CHECK(std::count(text.begin(), text.end(), '\n') == 1);
    CHECK_THAT(text, Catch::Contains("cannot write game.ndjson: the disk is gone"));
    const auto verdict = replay::verify(replay::ReplaySource::of_bytes(kept, "kept"));
    if (failing_write == 1) {
      CHECK(kept.empty());
    } else {
      REQUIRE(verdict);
      CHECK(verdict->ok());
      CHECK(verdict->cut_off == (failing_write == 2));
    }
  }
}

TEST_CASE("a recording that cannot be created is told with the reason") {
  Log log;
  const auto recorder = open("/no/such/folder/game.ndjson", log);
  REQUIRE_FALSE(recorder);
  CHECK_THAT(recorder.error().text(),
             Catch::Contains("/no/such/folder/game.ndjson") && Catch::Contains("mkdir -p /no/such/folder/"));
}
