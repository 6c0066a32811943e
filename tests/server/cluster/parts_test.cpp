// Batches that no message of NATS has room for.
#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <vector>

#include "tests/server/cluster/logged_room.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

namespace {

/// The same in three messages; the rooms' places but with the last one.
std::vector<Batch> in_parts(const Batch& batch, std::uint64_t number) {
  std::vector<Batch> parts(3, batch);
  for (std::uint32_t k = 0; k < 3; ++k) {
    parts[k].head.number = number + k;
    parts[k].head.part = k;
    parts[k].head.parts = 3;
    if (k != 2) parts[k].head.rooms.clear();
    const std::size_t piece = batch.lines.size() / 3;
    parts[k].lines = batch.lines.substr(k * piece, k == 2 ? std::string::npos : piece);
  }
  return parts;
}

}  // namespace

TEST_CASE(
    "a batch in parts counts once all are there, and never where one is missing or another host goes on") {
  Shard shard;
  shard.open();
  shard.join("ann");
  shard.step(30);
  shard.cut();
  shard.step(30);
  shard.cut();
  const std::vector<Batch> first = in_parts(shard.batches[0], 0), second = in_parts(shard.batches[1], 3);
  ShardView view;
  std::uint64_t sequence = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(view.rooms().empty());
    REQUIRE(view.take(++sequence, first[k]));
  }
  CHECK(followed(view).tick() == 30);
  // Who begins to read in the middle is told to begin at the first part.
  CHECK(ShardView::beginning({2, first[1].head}).from == 1);
  for (std::size_t k = 0; k < 2; ++k) REQUIRE(view.take(++sequence, second[k]));
  CHECK(followed(view).tick() == 30);
  SECTION("it is whole") {
    REQUIRE(view.take(++sequence, second[2]));
    CHECK(followed(view).tick() == 60);
    CHECK(followed(view).hash() == shard.game->hash());
  }
  SECTION("its last part is gone") {
    view.lose(++sequence);
    Batch next = shard.batches[1];
    next.head.number = 6;
    next.lines.clear();
    REQUIRE(view.take(++sequence, next));
    CHECK(followed(view).tick() == 30);
  }
  SECTION("its host is gone: another one goes on from before it") {
    Shard other(2);
    other.first = sequence + 1;
    const match::Match& left = followed(view);
    other.open("volcano", match::Match::restore(left.shared_map(), left.settings(), left.state()));
    other.step(20);
    other.cut();
    read_all(view, other);
    CHECK(followed(view).tick() == 50);
    CHECK(followed(view).hash() == other.game->hash());
  }
  CHECK(view.difference().empty());
}
