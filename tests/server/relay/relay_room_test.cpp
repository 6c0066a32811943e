// A room that is played elsewhere and shown here.
#include "server/relay/relay_room.h"

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include "server/relay/relay.h"
#include "shared/follow/follower.h"
#include "tests/server/relay/edge.h"

namespace woodlouse::server::test {
namespace {

/// How many of its frames say the hash of their tick; all that say one must say that.
std::size_t proven_frames(const Edge& edge, const Guest& guest) {
  std::size_t proven = 0;
  for (const Frame& frame : guest.frames) {
    const std::string& text = *frame.text;
    const auto at = text.find(R"("hash":")");
    if (at == std::string::npos) continue;
    INFO("tick " << frame.tick);
    REQUIRE(text.substr(at + 8, 16) == edge.hashes.at(frame.tick));
    ++proven;
  }
  return proven;
}

}  // namespace

TEST_CASE("who watches where a room is shown gets the frames of the room, evenly") {
  Edge edge;
  edge.shard.open();
  edge.shard.join("ann");
  edge.go_on(5);
  CHECK(edge.times_ready == 1);
  const auto eve = edge.join(2, watching("eve"));
  REQUIRE(eve->welcomes.size() == 1);
  CHECK(eve->welcomes[0].id == 0);
  REQUIRE(eve->welcomes[0].players.size() == 1);
  CHECK(eve->welcomes[0].players[0].name == "ann");
  CHECK(edge.room->census() == protocol::RoomEntry{"volcano", "volcano", 1, 0, 1});
  std::vector<Time> shown;
  std::vector<std::uint64_t> ticks;
  for (int part = 0; part < 30; ++part) {
    edge.play(6);
    for (int k = 0; k < 20; ++k) {
      const std::size_t before = eve->frames.size();
      edge.pass(milliseconds(5));
      for (std::size_t n = before; n < eve->frames.size(); ++n) {
        shown.push_back(edge.timekeeper.now());
        ticks.push_back(eve->frames[n].tick);
      }
    }
  }
  REQUIRE(shown.size() >= 55);
  for (std::size_t n = 1; n < shown.size(); ++n) {
    CHECK(ticks[n] == ticks[n - 1] + 3);
    CHECK(shown[n] - shown[n - 1] <= milliseconds(60));
    CHECK(shown[n] - shown[n - 1] >= milliseconds(40));
  }
  CHECK(proven_frames(edge, *eve) >= 3);
  CHECK(edge.room->proven() >= 200);
  CHECK(edge.lost.empty());
}

TEST_CASE("who watches by inputs where a room is shown proves each tick of it") {
  Edge edge;
  edge.shard.open();
  edge.shard.join("ann");
  edge.go_on(5);
  const auto eve = edge.join(2, watching("eve", protocol::Stream::kInputs));
  edge.go_on(20);
  follow::Follower follower("test");
  std::uint64_t due = 0;
  for (const StreamPart& part : eve->parts) {
    if (!part.lines) continue;
    if (part.kind == StreamPart::Kind::kSteps && part.first < due) continue;  // as a session passes it over
    REQUIRE((part.kind != StreamPart::Kind::kSteps || part.first == due));
    due = part.next;
    const std::string& text = *part.lines;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
      end = text.find('\n', at);
      const bool is_taken = follower.take(std::string_view(text).substr(at, end - at));
      INFO((is_taken ? std::string() : follower.difference()->what));
      REQUIRE(is_taken);
    }
  }
  CHECK(follower.proven() >= 100);
  CHECK(follower.match()->hash() != 0);
}

TEST_CASE("joins, leaves and chat of a room that is shown are events, and what is said here reaches nobody") {
  Edge edge;
  edge.shard.open();
  edge.go_on(2);
  const auto eve = edge.join(2, watching("eve"));
  edge.shard.join("ann");
  edge.shard.tap->chat(edge.shard.game->tick(), 0, "bob", "hello");
  edge.go_on(3);
  edge.shard.game->leave(edge.shard.lice.back());
  edge.shard.lice.clear();
  edge.go_on(3);
  std::string all;
  for (const std::string& line : eve->lines) all += line;
  CHECK(all.find(R"("kind":"joined","id":1,"name":"ann")") != std::string::npos);
  CHECK(all.find(R"("text":"hello")") != std::string::npos);
  CHECK(all.find(R"("kind":"left","id":1,"name":"ann")") != std::string::npos);
  CHECK(edge.room->census().players == 0);
  edge.room->door()->submit(2, protocol::Chat{"here"}, edge.timekeeper.now());
  edge.settle();
  REQUIRE(eve->answers.size() == 1);
  CHECK(std::get<protocol::ErrorMessage>(eve->answers[0]).code == "only_shown");
  edge.room->door()->leave(2, Parting::kLeft);
  edge.settle();
  CHECK(edge.room->census().spectators == 0);
}

TEST_CASE("a log that is read again, or goes on by another host's hand, is shown on without a new welcome") {
  Edge edge;
  edge.shard.open();
  edge.shard.join("ann");
  edge.go_on(5);
  const auto eve = edge.join(2, watching("eve"));
  edge.go_on(3);
  const std::uint64_t before = edge.room->proven();
  // Read again from the beginning.
  edge.read(edge.shard);
  for (std::size_t k = 0; k < edge.shard.batches.size(); ++k)
    REQUIRE(edge.view->take(edge.shard.first + k, edge.shard.batches[k]));
  edge.room->take(std::exchange(edge.lines, {}));
  edge.settle();
  CHECK(edge.room->proven() == before);
  edge.go_on(3);
  // By another host: its header has a parent, its first line is a keyframe.
  Shard other(2);
  other.first = 100;
  other.open("volcano",
             match::Match::restore(volcano(), edge.shard.game->settings(), edge.shard.game->state()));
  other.lice = edge.shard.lice;
  other.seq = edge.shard.seq;
  edge.read(other);
  edge.go_on(10);
  CHECK(edge.lost.empty());
  CHECK(eve->byes.empty());
  CHECK(eve->welcomes.size() == 1);
  CHECK(eve->frames.back().tick + 12 >= other.game->tick());
  CHECK(proven_frames(edge, *eve) >= 2);
}

TEST_CASE("another game in a room that is shown is welcomed") {
  Edge edge;
  edge.shard.open();
  edge.go_on(5);
  const auto eve = edge.join(2, watching("eve"));
  edge.go_on(3);
  Shard other(2);
  other.open("volcano", 77);
  edge.hashes.clear();
  const std::size_t before = eve->frames.size();
  edge.read(other);
  edge.go_on(5);
  REQUIRE(eve->welcomes.size() == 2);
  CHECK(eve->welcomes[1].tick == 0);
  CHECK(eve->frames_at_welcome[1] >= before);
  CHECK(eve->frames.size() > eve->frames_at_welcome[1]);
}

TEST_CASE("a line that was altered ends what is shown, and who watched is told") {
  Edge edge;
  edge.shard.open();
  edge.shard.join("ann");
  edge.go_on(5);
  const auto eve = edge.join(2, watching("eve"));
  edge.shard.step(6);
  edge.shard.cut();
  REQUIRE(edge.view->take(edge.shard.batches.size(), edge.shard.batches.back()));
  std::string& line = edge.lines.back();
  const auto at = line.find(R"("hash":")") + 8;
  line[at] = line[at] == '0' ? '1' : '0';
  edge.room->take(std::exchange(edge.lines, {}));
  edge.pass(milliseconds(400));
  CHECK(edge.lost.find("hash") != std::string::npos);
  REQUIRE(eve->byes.size() == 1);
  const auto late = edge.join(3, watching("late"));
  CHECK(late->refusals.size() == 1);
}

TEST_CASE("whatever stands in a log, it ends what is shown and nothing else") {
  for (const char* wrong :
       {R"({"step":18446744073709551615,"hash":"0000000000000000"})",
        R"({"step":18446744073709551615,"steps":18446744073709551615,"hash":"0000000000000000"})",
        R"({"step":1000000,"hash":"0000000000000000"})", R"({"step":-1})", R"({"step":)", "", "{",
        R"({"chat":1})", R"({"keyframe":18446744073709551615})", R"({"keyframe":99999999,"hash":"x"})",
        R"({"end":1})"}) {
    INFO(wrong);
    Edge edge;
    edge.shard.open();
    edge.go_on(3);
    const auto eve = edge.join(2, watching("eve"));
    edge.room->take({wrong});
    edge.pass(milliseconds(600));
    edge.shard.step(6);
    edge.come();
    edge.pass(milliseconds(600));
    CHECK(edge.lost.empty() == eve->byes.empty());
    CHECK((!edge.lost.empty() || eve->frames.back().tick + 3 >= edge.shard.game->tick()));
  }
}

TEST_CASE("where a room is shown there are places, too") {
  Edge edge(2);
  edge.shard.open();
  edge.go_on(2);
  const auto first = edge.join(2, watching("a"));
  edge.join(3, watching("b"));
  const auto third = edge.join(4, watching("c"));
  CHECK(first->welcomes.size() == 1);
  REQUIRE(third->refusals.size() == 1);
  CHECK(third->refusals[0].code == "room_full");
  edge.room->door()->leave(2, Parting::kLost);
  edge.settle();
  CHECK(edge.join(5, watching("d"))->welcomes.size() == 1);
}

TEST_CASE("a room that stands still is shown where it stands") {
  Edge edge;
  edge.shard.open();
  edge.shard.join("ann");
  edge.go_on(5);
  const auto eve = edge.join(2, watching("eve"));
  edge.play(5);
  edge.pass(milliseconds(1000));
  CHECK(eve->frames.back().tick == edge.shard.game->tick());
  const auto late = edge.join(3, watching("late", protocol::Stream::kInputs));
  REQUIRE(late->parts.size() >= 2);
  CHECK(late->parts[1].kind == StreamPart::Kind::kKeyframe);
  CHECK(late->parts[1].next == edge.shard.game->tick());
}

TEST_CASE("rooms that are shown are found once there is something to show, until they are closed") {
  Edge edge;
  RoomSettings settings;
  Relay relay(edge.ticks, edge.lanes, settings, edge.limits, kDelay, edge.timekeeper, edge.log);
  edge.shard.open();
  edge.shard.step(6);
  edge.shard.cut();
  REQUIRE(edge.view->take(1, edge.shard.batches.back()));
  relay.take("volcano", {edge.lines[0]});
  edge.settle();
  CHECK(relay.names().empty());
  CHECK(relay.why_not_ready(edge.timekeeper.now()) == "no room is shown yet");
  CHECK(relay.find("volcano") == nullptr);
  const std::uint64_t before = relay.changes();
  relay.take("volcano", std::vector<std::string>(edge.lines.begin() + 1, edge.lines.end()));
  edge.settle();
  CHECK(relay.changes() > before);
  CHECK(relay.names() == std::vector<std::string>{"volcano"});
  CHECK(relay.why_not_ready(edge.timekeeper.now()).empty());
  bool hears = false;
  relay.set_hears([&hears] { return hears; });
  CHECK(relay.why_not_ready(edge.timekeeper.now()) == "NATS is not connected: what is shown stands");
  hears = true;
  CHECK(relay.why_not_ready(edge.timekeeper.now()).empty());
  REQUIRE(relay.find("") != nullptr);
  CHECK(relay.find("")->only_shows());
  CHECK(relay.list().rooms[0].map == "volcano");
  const auto eve = static_cast<Contexts&>(edge).join(*relay.find("volcano"), 7, watching("eve"));
  CHECK(eve->welcomes.size() == 1);
  relay.close("volcano");
  edge.settle();
  REQUIRE(eve->byes.size() == 1);
  CHECK(relay.find("volcano") == nullptr);
  CHECK(relay.list().rooms.empty());
}

}  // namespace woodlouse::server::test
