#include "server/watchers/recordings.h"

#include <unistd.h>
#include <filesystem>
#include <future>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include <spdlog/sinks/ostream_sink.h>

#include "shared/map/map_file.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/source_file.h"

using namespace woodlouse;
using namespace woodlouse::server;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

namespace fs = std::filesystem;

/// A folder, a log, and a game of 60 ticks a second that is played by hand.
struct Night {
  Night() : folder(fs::temp_directory_path() / ("woodlouse_recordings_test_" + std::to_string(::getpid()))) {
    fs::create_directory(folder);
    game.join({"mara", state::Role::kPlayer});
  }
  ~Night() { fs::remove_all(folder); }
  Night(const Night&) = delete;
  Night& operator=(const Night&) = delete;

  static std::shared_ptr<const map::Map> load() {
    auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
    REQUIRE(map);
    return *map;
  }
  [[nodiscard]] RecordSettings settings(const std::string& name) const {
    return {*RecordPattern::parse((folder / name).string(), 1)};
  }
  [[nodiscard]] replay::Header header() const { return replay::make_header(game, "test", "volcano.json"); }
  void begin(Recorder& recorder) {
    recorder.attach([this](const protocol::Notice& notice) { told.push_back(notice); });
    recorder.begin(started);
  }
  /// Until what was told is written: a game by hand is faster than any disk.
  static void catch_up(const Recorder& recorder) {
    std::promise<void> done;
    if (recorder.thread()->post([&done] { done.set_value(); })) done.get_future().wait();
  }
  void play(Recorder& recorder, int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      if (game.tick() % 10 == 1) game.file({1, ++seq, {state::ThrustKind::kAlongHeading, {0.5, 0.0}}, 5, 0});
      const match::StepRecord& step = game.advance();
      recorder.step(LiveStep(step, {}), game);
      if (tick % 1000 == 999) catch_up(recorder);
    }
  }
  [[nodiscard]] std::size_t lines_of(const std::string& words) const {
    std::istringstream lines(text.str());
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.find(words) != std::string::npos ? 1 : 0;
    return count;
  }

  fs::path folder;
  std::ostringstream text;
  std::shared_ptr<spdlog::logger> log =
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text));
  std::shared_ptr<const map::Map> map = load();
  match::Match started{map, {60, 99}};
  match::Match game{map, {60, 99}};
  std::uint32_t seq = 0;
  std::vector<protocol::Notice> told;
};

Time in_a_minute() { return Clock::now() + seconds(60); }

/// All of a file that a test asks for.
struct Contents {
  replay::Header header;
  std::vector<match::MatchState> keyframes;
  std::string reason;
};

Contents read(const fs::path& file) {
  const replay::ReplaySource source = replay::source_of_file(file);
  const auto stream = source.open();
  REQUIRE(stream);
  replay::ReplayReader reader(**stream, source.name);
  const auto header = reader.read_header();
  REQUIRE(header);
  Contents result{*header, {}, {}};
  for (;;) {
    const auto line = reader.next();
    REQUIRE(line);
    if (!*line) return result;
    if (const auto* keyframe = std::get_if<replay::Keyframe>(&**line))
      result.keyframes.push_back(keyframe->state);
    if (const auto* end = std::get_if<replay::End>(&**line)) result.reason = end->reason;
  }
}

std::string verdict(const fs::path& file) {
  const auto result = replay::verify(replay::source_of_file(file), 1);
  return result ? replay::to_text(*result) : result.error().text();
}

}  // namespace

TEST_CASE(
    "a game over three files: each verifies, no tick is lost, one ends with what the next begins with") {
  for (const bool is_asked : {false, true}) {
    Night night;
    RecordSettings settings = night.settings("game.ndjson.zst");
    if (!is_asked) settings.every = seconds(0);  // at each keyframe
    Recordings recordings(settings, night.log);
    auto recorder = recordings.open("volcano", night.header());
    REQUIRE(recorder);
    night.begin(**recorder);
    for (int file = 0; file < 2; ++file) {
      if (is_asked) CHECK(recordings.ask_for_next_files() == 1);
      night.play(**recorder, 300);
    }
    night.play(**recorder, 100);
    (*recorder)->finish("test over", [] {});
    recordings.end(in_a_minute());
    CHECK(recordings.lost().empty());
    CHECK(night.told.empty());

    const std::vector<fs::path> files = {night.folder / "game.ndjson.zst", night.folder / "game.1.ndjson.zst",
                                         night.folder / "game.2.ndjson.zst"};
    CHECK(verdict(files[0]) == "ok ticks 0 to 300\n");
    CHECK(verdict(files[1]) == "ok ticks 300 to 600, the start is taken on trust\n");
    CHECK(verdict(files[2]) == "ok ticks 600 to 700, the start is taken on trust\n");
    for (std::size_t k = 1; k < files.size(); ++k) {
      const Contents before = read(files[k - 1]);
      const Contents after = read(files[k]);
      const match::MatchState& last = before.keyframes.back();
      const match::MatchState& first = after.keyframes.front();
      CHECK(before.reason == "continued in " + files[k].string());
      CHECK(after.header.parent == replay::Parent{files[k - 1].string(), last.tick, last.hash});
      CHECK(first.tick == 300 * k);
      CHECK(first.tick == last.tick);
      CHECK(first.hash == last.hash);
      CHECK(first.link == last.link);
      CHECK(first.lice == last.lice);
      CHECK(first.waiting == last.waiting);
      CHECK(first.players == last.players);
      CHECK(first.next_player == last.next_player);
    }
    CHECK(read(files[2]).reason == "test over");
    CHECK(night.lines_of("continued in") == 2);
  }
}

TEST_CASE("where no file can follow, the recording goes on in the one it has") {
  Night night;
  RecordSettings settings = night.settings("game.ndjson");
  settings.every = seconds(0);
  Recordings recordings(settings, night.log);
  auto recorder = recordings.open("volcano", night.header());
  REQUIRE(recorder);
  night.begin(**recorder);
  const fs::path moved = night.folder.string() + "_moved";
  fs::rename(night.folder, moved);
  night.play(**recorder, 400);
  (*recorder)->finish("test over", [] {});
  recordings.end(in_a_minute());
  fs::rename(moved, night.folder);
  CHECK(night.lines_of("no file that another could follow") + night.lines_of("no recording can follow") == 1);
  CHECK(recordings.lost().empty());
  CHECK(verdict(night.folder / "game.ndjson") == "ok ticks 0 to 400\n");
}

TEST_CASE("what all may have together is kept: old files go, and a file past it ends whole, loudly, once") {
  Night night;
  RecordSettings settings = night.settings("game.ndjson");
  settings.every = seconds(0);
  settings.keep_bytes = 50'000;  // two files and a bit
  {
    Recordings recordings(settings, night.log);
    auto recorder = recordings.open("volcano", night.header());
    REQUIRE(recorder);
    night.begin(**recorder);
    night.play(**recorder, 2000);
    (*recorder)->finish("test over", [] {});
    recordings.end(in_a_minute());
    CHECK(recordings.lost().empty());
    CHECK(night.told.empty());
    CHECK(night.lines_of("of the oldest recordings") > 0);
  }
  std::uint64_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(night.folder)) {
    bytes += entry.file_size();
    CHECK_THAT(verdict(entry.path()), Catch::StartsWith("ok "));
  }
  CHECK(bytes <= 60'000);  // an end is written past the bound
  CHECK(bytes > 20'000);

  Night other;
  settings = other.settings("alone.ndjson");
  settings.keep_bytes = 20'000;
  Recordings recordings(settings, other.log);
  auto recorder = recordings.open("volcano", other.header());
  REQUIRE(recorder);
  other.begin(**recorder);
  other.play(**recorder, 1000);
  (*recorder)->finish("test over", [] {});
  recordings.end(in_a_minute());
  REQUIRE(recordings.lost().size() == 1);
  CHECK_THAT(recordings.lost()[0], Catch::Contains("alone.ndjson: all that --record-keep grants is used up"));
  CHECK(other.told.size() == 1);
  CHECK(other.lines_of("RECORDING ENDED") == 1);
  CHECK_THAT(verdict(other.folder / "alone.ndjson"),
             Catch::StartsWith("ok ticks 0 to") && !Catch::Contains("cut off"));
}

namespace {

/// Stands still in its first write, until it is let go.
class StuckSink final : public core::ByteSink {
 public:
  StuckSink(std::promise<void>& stands, std::shared_future<void> until)
      : stands_(stands), until_(std::move(until)) {}
  core::Expected<void> write(std::string_view) override {
    stands_.set_value();
    until_.wait();
    return core::fail("sink", "gone");
  }
  core::Expected<void> close() override { return {}; }

 private:
  std::promise<void>& stands_;
  std::shared_future<void> until_;
};

}  // namespace

TEST_CASE("a writer that stands in a write is left behind: it is named, and touches nobody once it wakes") {
  Night night;
  std::promise<void> stands;
  std::promise<void> goes_on;
  std::shared_ptr<JobThread> thread;
  bool is_done = false;
  {
    Recorder recorder(std::make_unique<StuckSink>(stands, goes_on.get_future().share()), "game.ndjson",
                      night.header(), night.log);
    thread = recorder.thread();
    night.begin(recorder);
    night.play(recorder, 100);
    stands.get_future().wait();
    night.play(recorder, 100);
    recorder.finish("test over", [&is_done] { is_done = true; });
    CHECK_FALSE(thread->wait_until(Clock::now() + milliseconds(10)));
    recorder.writer()->leave_behind("the disk takes nothing");
    CHECK(recorder.writer()->lost() == "game.ndjson: the disk takes nothing");
    CHECK(night.lines_of("RECORDING UNFINISHED: game.ndjson: the disk takes nothing") == 1);
  }
  goes_on.set_value();
  REQUIRE(thread->wait_until(in_a_minute()));
  CHECK_FALSE(is_done);
  CHECK(night.told.empty());
  CHECK(night.lines_of("") == 1);
}
