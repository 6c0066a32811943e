// Recordings of a log.
#include <stdlib.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <sstream>
#include <string>

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
