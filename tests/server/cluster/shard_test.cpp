// A shard's log from its rooms to who follows it.
#include <catch2/catch.hpp>

#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "server/cluster/joined_log.h"
#include "tests/server/cluster/logged_room.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

TEST_CASE("who follows a log has each tick of its rooms, and who may come back") {
  Shard shard;
  shard.open();
  shard.join("ann");
  shard.step(30);
  shard.join("ben");
  shard.cut();
  shard.step(400);
  shard.cut();
  ShardView view;
  read_all(view, shard);
  CHECK(followed(view).tick() == 430);
  CHECK(followed(view).hash() == shard.game->hash());
  CHECK(replay::first_difference(followed(view).world().lice(), shard.game->world().lice()).empty());
  CHECK(view.rooms().at("volcano").claims.size() == 2);
  CHECK(view.difference().empty());
  CHECK(view.proven() == 430);
}

TEST_CASE("who comes late begins at the newest keyframe, by what the last batch says") {
  Shard shard;
  shard.open();
  shard.join("ann");
  for (int k = 0; k < 20; ++k) {
    shard.step(50);
    shard.cut();
  }
  const auto beginning = ShardView::beginning({shard.batches.size(), shard.batches.back().head});
  CHECK(beginning.from == 18);  // ticks 850 to 900
  REQUIRE(beginning.headers.at(1) == ShardView::RoomNames{"volcano"});
  ShardView view;
  REQUIRE(view.take_headers({"volcano"}, shard.batches[0].lines, "x"));
  CHECK_FALSE(view.take_headers({"volcano", "hills"}, shard.batches[0].lines, "x"));
  read_all(view, shard, beginning.from - 1);
  CHECK(followed(view).hash() == shard.game->hash());
  CHECK(followed(view).tick() == 1000);
  CHECK(view.rooms().at("volcano").claims.size() == 1);
  CHECK(view.difference().empty());
}

TEST_CASE("who has missed a room's beginning knows that he lacks the room") {
  Shard shard;
  shard.open();
  shard.join("ann");
  shard.step(30);
  shard.cut();
  shard.step(30);
  shard.cut();
  ShardView late;
  REQUIRE(late.take(2, shard.batches[1]));
  CHECK(late.rooms().empty());
  CHECK(late.lacks_rooms());
  ShardView view;
  read_all(view, shard);
  CHECK_FALSE(view.lacks_rooms());
}

TEST_CASE("a claim goes with its louse") {
  Shard shard;
  shard.open();
  shard.join("ann");
  shard.join("ben");
  shard.step(10);
  shard.game->leave(shard.lice[0]);
  shard.lice.erase(shard.lice.begin());
  shard.step(300);
  shard.cut();
  ShardView view;
  read_all(view, shard);
  REQUIRE(view.rooms().at("volcano").claims.size() == 1);
  CHECK(view.rooms().at("volcano").claims.begin()->second.name == "ben");
}

TEST_CASE("what the desk refuses is a hole up to the next keyframe, and from there on the log holds again") {
  Shard shard;
  shard.open();
  shard.join("ann");
  shard.step(100);
  shard.desk->is_full = true;
  shard.step(50);
  shard.desk->is_full = false;
  shard.step(100);
  shard.cut();
  ShardView view;
  read_all(view, shard);
  CHECK(followed(view).tick() == 100);
  shard.step(100);  // past tick 300
  shard.cut();
  read_all(view, shard, 1);
  CHECK(followed(view).tick() == 350);
  CHECK(followed(view).hash() == shard.game->hash());
  CHECK(view.rooms().at("volcano").follower->gaps() == 1);
  CHECK(view.difference().empty());
  std::ostringstream told;
  JoinedLog joined({}, told);
  for (std::size_t k = 0; k < shard.batches.size(); ++k) REQUIRE(joined.take(k + 1, shard.batches[k]));
  CHECK(joined.holes() == 1);
  CHECK(told.str().find("ticks 100 to 300") != std::string::npos);
}

TEST_CASE("a game whose beginning was refused is told from its next keyframe on") {
  Shard shard;
  shard.desk->is_full = true;
  shard.open();
  shard.join("ann");
  shard.step(100);
  shard.desk->is_full = false;
  shard.step(300);
  shard.cut();
  ShardView view;
  read_all(view, shard);
  CHECK(followed(view).hash() == shard.game->hash());
}

TEST_CASE("lines that are dropped are told anew, and rooms that stand still when it is time") {
  Shard shard;
  shard.open();
  shard.step(300);
  shard.cut();
  shard.step(10);
  shard.text.lose();
  shard.step(10);
  CHECK(shard.text.size() == 0);
  shard.step(280);  // tick 600
  shard.cut();
  shard.tap->fall_asleep(*shard.game);
  shard.text.renew(shard.desk->now + std::chrono::minutes(19), 1 << 20);
  CHECK(shard.text.size() == 0);
  shard.text.renew(shard.desk->now + std::chrono::minutes(21), 0);  // there is no room for more lines
  CHECK(shard.text.size() == 0);
  shard.text.renew(shard.desk->now + std::chrono::minutes(21), 1 << 20);
  shard.cut();
  CHECK(shard.batches.back().head.rooms.at(0) == RoomPlace{"volcano", 3, 3, 600});
  ShardView view;
  read_all(view, shard, 2);
  CHECK(followed(view).tick() == 600);
}

TEST_CASE("a log that begins anew is told of every room with its next step") {
  Shard shard;
  shard.open();
  shard.join("ann");
  shard.step(100);
  shard.text.lose();
  ++shard.desk->begun;
  shard.step();
  shard.cut();
  ShardView view;
  read_all(view, shard);
  CHECK(followed(view).tick() == 101);
  CHECK(followed(view).hash() == shard.game->hash());
  CHECK(view.rooms().at("volcano").claims.size() == 1);
}

TEST_CASE("what is passed over leaves what was read as it was") {
  Shard shard;
  shard.open();
  shard.step(10);
  shard.cut();
  ShardView view;
  read_all(view, shard);
  view.pass_over(2);
  shard.first = 2;  // its second batch is the stream's third
  shard.step(10);
  shard.cut();
  REQUIRE(view.take(3, shard.batches[1]));
  CHECK(followed(view).tick() == 20);
}

TEST_CASE("a room that is closed is gone, but not where it goes on elsewhere") {
  Shard shard;
  shard.open();
  shard.step(10);
  shard.cut();
  const bool goes_on = GENERATE(false, true);
  if (goes_on) shard.text.keep_rooms();
  shard.tap->finish("over", [] {});
  shard.cut();
  ShardView view;
  read_all(view, shard);
  CHECK(view.rooms().contains("volcano") == goes_on);
  CHECK(shard.batches.back().head.rooms.empty() != goes_on);
}

TEST_CASE("another game of a room takes the place of the one before, whose end comes later") {
  Shard shard;
  shard.open("volcano", 5);
  shard.step(10);
  const auto former = std::move(shard.tap);
  shard.open("volcano", 6);
  former->finish("the room plays another game", [] {});
  shard.step(20);
  shard.cut();
  ShardView view;
  read_all(view, shard);
  CHECK(followed(view).tick() == 20);
  CHECK(followed(view).hash() == shard.game->hash());
}

TEST_CASE("a room too many is in no log, and hears it") {
  Shard shard;
  std::vector<std::unique_ptr<match::Match>> games;
  std::vector<std::unique_ptr<LogTap>> taps;
  int told = 0;
  for (std::size_t k = 0; k <= kMostRoomsOfShard; ++k) {
    games.push_back(
        std::make_unique<match::Match>(volcano(), match::MatchSettings{60, k, state::Mode::kRoam}));
    taps.push_back(std::make_unique<LogTap>(shard.desk, "room " + std::to_string(k),
                                            replay::make_header(*games.back(), "test", "volcano.json"),
                                            std::chrono::hours(1)));
    taps.back()->attach(
        [&told](const protocol::Notice& notice) { told += notice.code == "not_durable" ? 1 : 0; });
    taps.back()->begin(*games.back());
  }
  shard.cut();
  CHECK(told == 1);
  CHECK(shard.batches[0].head.rooms.size() == kMostRoomsOfShard);
  ShardView view;
  read_all(view, shard);
  CHECK(view.rooms().size() == kMostRoomsOfShard);
}

TEST_CASE("a game that stood still for too long is in doubt, and shown to nobody till the log was asked") {
  Shard shard;
  shard.open();
  shard.step();
  CHECK(shard.tap->may_show());
  LogTap hasty(shard.desk, "hills", replay::make_header(*shard.game, "test", "volcano.json"), Duration{-1});
  const match::StepRecord& record = shard.game->advance();
  hasty.step(LiveStep(record, {}), *shard.game);
  CHECK(hasty.may_show());  // its first one
  hasty.wake(*shard.game);
  hasty.step(LiveStep(record, {}), *shard.game);
  CHECK(hasty.may_show());  // the first one after it stood still
  hasty.step(LiveStep(record, {}), *shard.game);
  CHECK_FALSE(hasty.may_show());
  CHECK_FALSE(shard.tap->may_show());  // so are all of the host
}

TEST_CASE("a strict game waits till its lines are stored, or are lost, and not for lines that are none") {
  Shard shard;
  shard.open();
  CHECK_FALSE(shard.tap->await_kept([] {}));  // of mode play
  LogTap strict(shard.desk, "hills", replay::make_header(*shard.game, "test", "volcano.json"),
                std::chrono::hours(1), true);
  int kept = 0;
  const auto count = [&kept] { ++kept; };
  CHECK(strict.await_kept(count));  // not begun: there is nothing to store
  CHECK(kept == 1);
  strict.begin(*shard.game);
  REQUIRE(strict.await_kept(count));
  CHECK(shard.text.is_awaited());
  shard.cut();
  for (const auto& stored : shard.text.take_awaiting()) stored();
  CHECK(kept == 2);
  CHECK_FALSE(shard.text.is_awaited());
  REQUIRE(strict.await_kept(count));
  shard.text.lose();
  CHECK(kept == 3);
  shard.desk->is_full = true;
  const match::StepRecord& record = shard.game->advance();
  strict.step(LiveStep(record, {}), *shard.game);
  CHECK_FALSE(strict.await_kept(count));  // its lines were refused
  CHECK(kept == 3);
}

TEST_CASE("batches out of their order, of an old epoch or another behavior are refused") {
  Shard shard;
  shard.open();
  for (int k = 0; k < 4; ++k) {
    shard.step(10);
    shard.cut();
  }
  ShardView view;
  REQUIRE(view.take(1, shard.batches[0]));
  CHECK_FALSE(view.take(3, shard.batches[1]));
  CHECK_FALSE(view.take(2, shard.batches[2]));
  Batch other = shard.batches[1];
  other.head.writer = {1, "b", {3, 3}};
  other.head.number = 0;
  CHECK_FALSE(view.take(2, other));  // the same epoch
  other.head.writer.epoch = 2;
  CHECK(view.take(2, other));
  other.head.behavior = match::kBehavior + 1;
  other.head.number = 1;
  const auto refused = view.take(3, other);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().text().find("behavior") != std::string::npos);
}

TEST_CASE("an altered line is named by room and tick, and is not forgotten when the game is told anew") {
  Shard shard;
  shard.open();
  shard.join("ann");
  shard.step(20);
  shard.cut();
  Batch altered = shard.batches[0];
  const std::string_view inputs = R"("inputs":[[1,0,[)";
  const std::size_t at = altered.lines.find(inputs);
  REQUIRE(at != std::string::npos);
  char& digit = altered.lines[at + inputs.size()];
  digit = digit == '1' ? '2' : '1';
  ShardView view;
  REQUIRE(view.take(1, altered));
  CHECK(view.difference().starts_with("room volcano: tick "));
  shard.step(300);
  shard.cut();
  read_all(view, shard, 1);
  CHECK(view.difference().starts_with("room volcano: tick "));
}
