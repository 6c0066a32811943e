// Recordings of a log.
#include <stdlib.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>

#include "server/cluster/joined_log.h"
#include "shared/replay/source_file.h"
#include "shared/replay/verify.h"
#include "tests/server/cluster/logged_room.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

namespace {

struct RecordingsFolder {
  RecordingsFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "woodlouse-joined-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~RecordingsFolder() { std::filesystem::remove_all(path); }
  RecordingsFolder(const RecordingsFolder&) = delete;
  RecordingsFolder& operator=(const RecordingsFolder&) = delete;
  std::filesystem::path path;
};

}  // namespace

TEST_CASE("a joined log of two hosts is one recording, and verifies") {
  const RecordingsFolder folder;
  Shard first;
  first.open();
  first.join("ann");
  first.step(777);
  first.cut();
  ShardView view;
  read_all(view, first);
  Shard second(2);
  second.first = 2;
  second.text.take_over(first.batches.back().head.rooms);
  second.open("volcano", match::Match::restore(volcano(), first.game->settings(), followed(view).state()));
  second.lice = first.lice;
  second.seq = first.seq;
  second.step(500);
  second.cut();
  read_all(view, second);
  CHECK(followed(view).hash() == second.game->hash());
  std::ostringstream told;
  JoinedLog joined(folder.path, told);
  REQUIRE(joined.take(1, first.batches[0]));
  REQUIRE(joined.take(2, second.batches[0]));
  REQUIRE(joined.close());
  CHECK(joined.holes() == 0);
  const auto verdict = replay::verify(replay::source_of_file(folder.path / "volcano.ndjson", {}));
  REQUIRE(verdict);
  CHECK_FALSE(verdict->difference);
  CHECK(verdict->ticks == 1277);
  CHECK(verdict->from_start());
}

TEST_CASE("a batch that is gone is a hole up to the next keyframe, and what is around it verifies") {
  const RecordingsFolder folder;
  Shard shard;
  shard.open();
  shard.join("ann");
  for (int k = 0; k < 14; ++k) {
    shard.step(50);
    shard.cut();
  }
  ShardView view;
  std::ostringstream told;
  JoinedLog joined(folder.path, told);
  constexpr std::uint64_t kGone = 3;  // ticks 100 to 150; the next keyframe is that of tick 300
  for (std::uint64_t sequence = 1; sequence <= shard.batches.size(); ++sequence) {
    if (sequence == kGone) {
      view.lose(sequence);
      joined.lose();
      continue;
    }
    REQUIRE(view.take(sequence, shard.batches[sequence - 1]));
    REQUIRE(joined.take(sequence, shard.batches[sequence - 1]));
    if (sequence == kGone + 1) CHECK(followed(view).tick() == 100);
    CHECK(view.has_gap() == (sequence > kGone && sequence < 6));  // the keyframe of tick 300 ends the sixth
  }
  joined.lose();
  REQUIRE(joined.close());
  CHECK(view.difference().empty());
  CHECK(view.proven() == 100 + 400);
  CHECK(followed(view).hash() == shard.game->hash());
  CHECK(joined.holes() == 2);
  CHECK(told.str().find("HOLE: ticks 100 to 300 are missing") != std::string::npos);
  CHECK(told.str().find("HOLE: from tick 700 on nothing is known") != std::string::npos);
  for (const auto& [file, ticks] : {std::pair{"volcano.ndjson", 100}, std::pair{"volcano.2.ndjson", 400}}) {
    const auto verdict = replay::verify(replay::source_of_file(folder.path / file, {}));
    REQUIRE(verdict);
    CHECK_FALSE(verdict->difference);
    CHECK(verdict->ticks == static_cast<std::uint64_t>(ticks));
  }
}

TEST_CASE("no file that is there already is written over, and no other room's") {
  const RecordingsFolder folder;
  // Both of these names, and the second file of the first, would be one file's.
  Shard shard;
  shard.open("a/b");
  shard.step(5);
  shard.cut();
  Shard other;
  other.open("a-b");
  other.step(7);
  other.cut();
  std::ostringstream told;
  JoinedLog joined(folder.path, told);
  REQUIRE(joined.take(1, shard.batches[0]));
  REQUIRE(joined.take(2, other.batches[0]));
  REQUIRE(joined.close());
  for (const auto& [file, ticks] : {std::pair{"a-b.ndjson", 5}, std::pair{"a-b.2.ndjson", 7}}) {
    const auto verdict = replay::verify(replay::source_of_file(folder.path / file, {}));
    REQUIRE(verdict);
    CHECK(verdict->ticks == static_cast<std::uint64_t>(ticks));
  }
  JoinedLog again(folder.path, told);
  const auto taken = again.take(1, shard.batches[0]);
  REQUIRE_FALSE(taken);
  CHECK(taken.error().where == (folder.path / "a-b.ndjson").string());
  CHECK(replay::verify(replay::source_of_file(folder.path / "a-b.ndjson", {}))->ticks == 5);
}

TEST_CASE("a room that begins anew, though its game went on, is told as a hole") {
  Shard first;
  first.open();
  first.step(100);
  first.cut();
  Shard second(2);
  second.open();
  second.step(10);
  second.cut();
  std::ostringstream told;
  JoinedLog joined({}, told);
  REQUIRE(joined.take(1, first.batches[0]));
  REQUIRE(joined.take(2, second.batches[0]));
  CHECK(joined.holes() == 1);
  CHECK(told.str().find("BEGINS ANEW at tick 0, though tick 100 was to come") != std::string::npos);
}
