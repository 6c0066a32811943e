#include "server/commands/fork.h"

#include <unistd.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>

#include "shared/map/map_file.h"
#include "shared/replay/writer.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

namespace fs = std::filesystem;

/// A recorded game of 700 ticks, kept in memory tick by tick.
class Played {
 public:
  /// named_map: instead of the map itself the header has that file.
  explicit Played(const std::string& named_map = {}) {
    auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
    REQUIRE(map);
    match::Match game(*map, {50, 99});
    replay::ReplayWriter writer;
    replay::Header header = replay::make_header(game, "test", named_map);
    if (!named_map.empty()) header.map_definition.clear();
    writer.append_header(bytes_, header);
    writer.append_keyframe(bytes_, game.state());
    game.join({"mara\x1b", state::Role::kPlayer});
    game.join();
    for (int tick = 0; tick < 700; ++tick) {
      states.push_back(game.state());
      const auto seq = static_cast<std::uint32_t>(tick);
      if (tick % 10 == 3) game.file({1, seq, {state::ThrustKind::kMapVector, {0.5, 0.25}}, 15, 0});
      writer.append_step(bytes_, game.advance());
      if (game.tick() % replay::keyframe_ticks(50) == 0) writer.append_keyframe(bytes_, game.state());
    }
    states.push_back(game.state());
    writer.append_end(bytes_, "test over");
    write();
  }
  ~Played() { fs::remove(file); }
  Played(const Played&) = delete;
  Played& operator=(const Played&) = delete;

  /// The first `from` behind `mark` becomes `to`.
  void alter(const std::string& from, const std::string& to, const std::string& mark = {}) {
    const std::size_t at = bytes_.find(from, bytes_.find(mark));
    REQUIRE(at != std::string::npos);
    bytes_.replace(at, from.size(), to);
    write();
  }
  void cut_before(const std::string& mark) {
    bytes_.resize(bytes_.find(mark));
    write();
  }
  [[nodiscard]] std::string failure_at(std::uint64_t tick) const {
    const auto start = open_fork({file, tick});
    REQUIRE_FALSE(start);
    CHECK_FALSE(start.error().hint.empty());
    return start.error().text();
  }

  fs::path file =
      fs::temp_directory_path() / ("woodlouse_fork_test_" + std::to_string(::getpid()) + ".ndjson");
  std::vector<match::MatchState> states;

 private:
  void write() const { std::ofstream(file, std::ios::binary) << bytes_; }
  std::string bytes_;
};

}  // namespace

TEST_CASE(
    "a fork has the state of its tick to the last bit, the recording's settings, and names its parent") {
  const Played played;
  for (const std::uint64_t tick : {0u, 1u, 249u, 250u, 251u, 700u}) {
    const auto start = open_fork({played.file, tick});
    REQUIRE(start);
    const match::MatchState state = start->match->state();
    CHECK(state.tick == tick);
    CHECK(state.hash == played.states[tick].hash);
    CHECK(state.link == played.states[tick].link);
    CHECK(state.lice.size() == played.states[tick].lice.size());
    CHECK(start->match->settings().tick_hz == 50);
    CHECK(start->match->settings().seed == 99);
    CHECK(start->parent == replay::Parent{played.file.string(), tick, played.states[tick].hash});
  }
}

TEST_CASE(
    "the lice of a fork have the names of those who played them, cleaned, and go on with their count of "
    "inputs") {
  const Played played;
  const auto start = open_fork({played.file, 400});
  REQUIRE(start);
  REQUIRE(start->unclaimed.size() == 1);  // nobody named the other one
  CHECK(start->unclaimed[0].louse == 1);
  CHECK(start->unclaimed[0].name == "mara");
  CHECK(start->unclaimed[0].next_seq == 0);
  CHECK(open_fork({played.file, 0})->unclaimed.empty());
}

TEST_CASE("a map that a recording only names is named on by its fork, where it was found") {
  const std::string map_file = WOODLOUSE_SOURCE_DIR "/maps/volcano.json";
  const Played played(map_file);
  CHECK_FALSE(open_fork({played.file, 3}));  // it is not beside the recording
  CHECK(open_fork({played.file, 3, WOODLOUSE_SOURCE_DIR "/maps"})->map_file == map_file);
}

TEST_CASE("a fork that nobody joins goes on as the recording does while that has no inputs") {
  const Played played;
  const auto start = open_fork({played.file, 404});
  REQUIRE(start);
  while (start->match->tick() < 413) {
    start->match->advance();
    CHECK(start->match->hash() == played.states[start->match->tick()].hash);
  }
}

TEST_CASE("an input that waits in a keyframe, and that the recording does not go on to apply, is no fork's") {
  Played played;
  played.alter("\"waiting\":[]", "\"waiting\":[[290,1,240,[64,32]]]", "{\"keyframe\":250,");
  for (const std::uint64_t tick : {250u, 260u, 290u}) {
    CHECK_THAT(played.failure_at(tick), Catch::Contains("differs at tick 290: inputs of step 290: none "
                                                        "recorded, player 1 seq 240 re-run: what"));
  }
  CHECK(open_fork({played.file, 240}));
}

TEST_CASE("a fork says what it takes on trust: the keyframe it began with, and inputs nobody saw applied") {
  Played played;
  CHECK(open_fork({played.file, 249})->on_trust.empty());
  CHECK(open_fork({played.file, 499})->on_trust == "the keyframe of tick 250");
  played.alter("\"waiting\":[]", "\"waiting\":[[600,1,240,[64,32]]]", "{\"keyframe\":500,");
  played.cut_before("{\"step\":550,");
  CHECK(open_fork({played.file, 520})->on_trust == "the keyframe of tick 500 and 1 waiting input");
}

TEST_CASE("a fork by an index that leaves a keyframe out is refused") {
  Played played;
  const std::string index = "{\"index\":700,";
  played.alter("[250,", "[251,", index);
  CHECK_THAT(played.failure_at(300),
             Catch::Contains("the keyframe of tick 251 is not where the index has it"));
  CHECK(open_fork({played.file, 250})->on_trust.empty());  // led to from tick 0
  played.alter("[251,", "[499,", index);
  CHECK_THAT(played.failure_at(300), Catch::Contains("the index leaves out the keyframe of tick 250"));
}

TEST_CASE("a fork of what is not there is refused with what to do") {
  Played played;
  CHECK_THAT(played.failure_at(701), Catch::Contains("has no tick 701, only 0 to 700") &&
                                         Catch::Contains("try:  woodlouse-server fork "));
  SECTION("no file") {
    fs::remove(played.file);
    CHECK_THAT(played.failure_at(3), Catch::Contains("no such file"));
  }
  SECTION("an altered input") {
    played.alter("\"inputs\":[[1,303,[64,32]", "\"inputs\":[[1,303,[64,31]");
    CHECK_THAT(played.failure_at(400), Catch::Contains("differs at tick 304"));
    CHECK(open_fork({played.file, 303}));
  }
  SECTION("a damaged line") {
    played.alter("{\"step\":310,", "{\"step\":310;");
    CHECK_THAT(played.failure_at(400), Catch::Contains(played.file.string() + ":"));
    CHECK(open_fork({played.file, 310}));
  }
  SECTION("a map that is not found") {
    const Played other("/no/such/map.json");
    CHECK_THAT(other.failure_at(3),
               Catch::Contains("map.json: no such file") && Catch::Contains("beside the recording"));
  }
}
