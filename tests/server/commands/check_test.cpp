#include "server/commands/check.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "server/commands/author_time.h"
#include "server/records/ghost_line.h"
#include "shared/core/whole_file.h"
#include "shared/match/match.h"
#include "shared/protocol/codec.h"
#include "tests/server/records/racing.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

namespace {

/// A ring's map in a file, and the ghost of its author's time beside it.
struct RingFolder : BoardsFolder {
  RingFolder() { fs::create_directory(path / "ghosts"); }

  std::string laps = R"("laps":2)";
  fs::path map = path / "ring.json", ghost = path / "ghosts" / "ring.json";
  protocol::GhostLine line = ghost_line(ring_run(ring_map(laps), 0.75), "mara", protocol::Board::kBots);

  static void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  void write_map(std::uint64_t author_ms, const std::string& race = "") const {
    write(map, ring_text(laps + R"(,"author_ms":)" + std::to_string(author_ms) + race));
  }
  void write_ghost() const { write(ghost, protocol::encode(line)); }
  [[nodiscard]] std::uint64_t proved_ms() const { return whole_milliseconds(line.run.time, line.tick_hz); }
  [[nodiscard]] std::pair<int, std::string> check() const {
    std::ostringstream out;
    const int code = check_command({map}, false, out);
    return {code, out.str()};
  }
  /// What is said of it beside that no gate of the ring wants a run-up. The code is 0.
  [[nodiscard]] std::string note() const {
    const auto [code, text] = check();
    CHECK(code == 0);
    const std::string ok =
        map.string() + ": ok\n" + map.string() +
        ": note: race: full thrust climbs every stretch from rest: no gate wants a run-up\n";
    REQUIRE(text.substr(0, ok.size()) == ok);
    const std::string rest = text.substr(ok.size()), begin = map.string() + ": note: ";
    if (rest.empty()) return rest;
    REQUIRE(rest.substr(0, begin.size()) == begin);
    return rest.substr(begin.size());
  }
  /// One line, and the code is 1.
  [[nodiscard]] std::string error() const {
    auto [code, text] = check();
    CHECK(code == 1);
    CHECK(std::count(text.begin(), text.end(), '\n') == 1);
    return text;
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a time is stated in whole milliseconds, rounded up") {
  CHECK(whole_milliseconds(0, 60) == 0);
  CHECK(whole_milliseconds(1, 60) == 1);
  CHECK(whole_milliseconds(60 * rules::kMomentsPerTick, 60) == 1000);
  CHECK(whole_milliseconds(60 * rules::kMomentsPerTick + 1, 60) == 1001);
  CHECK(whole_milliseconds(3 * rules::kMomentsPerTick, 1000) == 3);
  CHECK(whole_milliseconds(UINT64_MAX, 1) == 281'474'976'710'656'000);
}

TEST_CASE("a ghost beside the map proves the author's time, and says whose it is") {
  RingFolder ring;
  ring.write_map(ring.proved_ms());
  ring.write_ghost();
  const std::string note = ring.note();
  CHECK(has(note, "race.author_ms: proved by ghosts/ring.json (\"mara\", "));
  CHECK(has(note, " s)\n"));
  const auto direct = judge_author_time(*ring_map(ring.laps), ring.map);  // states no time
  REQUIRE_FALSE(direct);
  CHECK(direct.error().where == ring.map.string());
}

TEST_CASE("a time that nothing proves is noted, and a race without a time is not") {
  RingFolder ring;
  ring.write_map(9000);
  CHECK(ring.note() == "race.author_ms: nothing proves it: there is no ghosts/ring.json beside the map\n");
  fs::remove(ring.path / "ghosts");
  CHECK(has(ring.note(), "nothing proves it"));
  ring.write_map(0);
  CHECK(ring.note().empty());
}

TEST_CASE("a ghost of another behavior can't be re-run, which is no fault of the map") {
  RingFolder ring;
  ring.write_map(9000);
  ring.line.behavior = match::kBehavior - 1;
  ring.write_ghost();
  CHECK(ring.note() == "race.author_ms: ghosts/ring.json is of behavior " +
                           std::to_string(match::kBehavior - 1) + ", can't be re-run here\n");
}

TEST_CASE("a ghost of another tick rate is re-run at that one, which is said") {
  RingFolder ring;
  match::Match game(ring_map(ring.laps), {120, 1, state::Mode::kRace});
  match::GhostTracks tracks(120);
  const match::PlayerId player = game.join({"timo", state::Role::kBot});
  game.file({player, 1, {state::ThrustKind::kMapVector, {0.75, 0.0}}, 120, 2});
  for (std::vector<match::DrivenRun>* runs = &tracks.take(game.advance()); ring.line.tick_hz != 120;
       runs = &tracks.take(game.advance())) {
    REQUIRE(game.tick() < 72'000);
    if (!runs->empty()) ring.line = line_of(runs->front(), 120, {});
  }
  ring.write_map(ring.proved_ms());
  ring.write_ghost();
  CHECK(has(ring.note(), " s, at 120 ticks/s)\n"));
}

TEST_CASE("a ghost whose time is not the map's, or that does not re-run, is an error that says what to do") {
  RingFolder ring;
  ring.write_map(ring.proved_ms() - 1);
  ring.write_ghost();
  const std::string proved = std::to_string(ring.proved_ms());
  CHECK(ring.error() == ring.map.string() + ": race.author_ms: is " + std::to_string(ring.proved_ms() - 1) +
                            ", but ghosts/ring.json proves " + proved + " (make it " + proved +
                            ", or take the ghost away)\n");
  ring.write_map(ring.proved_ms());
  ring.line.ghost.inputs[0].thrust.value.x -= 1.0 / 128.0;
  ring.write_ghost();
  const std::string altered = ring.error();
  CHECK(altered.find(ring.ghost.string() + ": does not prove the map's race.author_ms: gate ") == 0);
  CHECK(has(altered, "(put the ghost of a run on this very map there, or take it away)"));
  ring.line.ghost.inputs[0].thrust.value.x += 1.0 / 128.0;
  ring.line.run.time -= 65536;  // said to be faster than it was
  ring.line.run.splits.back() = ring.line.run.time;
  ring.write_ghost();
  CHECK(has(ring.error(), "is said to be driven through at tick"));
}

TEST_CASE("a ghost's file that is none, is no file, or lies elsewhere is an error and keeps nobody waiting") {
  RingFolder ring;
  ring.write_map(ring.proved_ms());
  ring.write(ring.ghost, "");
  CHECK(ring.error().find(ring.ghost.string() + ": ") == 0);
  ring.write(ring.ghost, R"({"type":"pong","id":1})");
  CHECK(ring.error().find(ring.ghost.string() + ": ") == 0);
  ring.write(ring.ghost, protocol::encode(ring.line) + protocol::encode(ring.line));
  CHECK(ring.error().find(ring.ghost.string() + ": ") == 0);
  ring.write(ring.ghost, std::string(kMaxGhostBytes + 1, ' '));
  CHECK(ring.error() == ring.ghost.string() +
                            ": longer than 4 MiB (put the ghost of a run on this very map there, or "
                            "take it away)\n");
  fs::remove(ring.ghost);
  REQUIRE(::mkfifo(ring.ghost.c_str(), 0600) == 0);
  CHECK(ring.error().find(ring.ghost.string() + ": ") == 0);
  fs::remove(ring.ghost);
  fs::create_directory(ring.ghost);
  CHECK(ring.error().find(ring.ghost.string() + ": ") == 0);
  fs::remove(ring.ghost);
  fs::create_symlink("/dev/zero", ring.ghost);
  CHECK(ring.error().find(ring.ghost.string() + ": ") == 0);
}

TEST_CASE("that no gate wants a run-up is not said where one does, or counts in the air alone") {
  RingFolder ring;
  const auto said = [&ring](const std::string& text) {
    RingFolder::write(ring.map, text);
    return has(ring.check().second, "no gate wants a run-up");
  };
  std::string text = ring_text(ring.laps);
  CHECK(said(text));
  const std::string gate = R"("b":[0,-4])", level = "[0,0,0,0,0,0,0,0,0]";
  std::string in_air = text, hill = text;
  in_air.replace(in_air.find(gate), gate.size(), gate + R"(,"air":true)");
  CHECK_FALSE(said(in_air));
  const std::string strong = R"("thrust_max":20)";
  hill.replace(hill.find(strong), strong.size(), R"("thrust_max":4)");
  CHECK(said(hill));
  for (std::size_t at = hill.find(level); at != std::string::npos; at = hill.find(level, at))
    hill.replace(at, level.size(), "[0,0,4,0,0,0,0,0,0]");
  CHECK_FALSE(said(hill));
}
