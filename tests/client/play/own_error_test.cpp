// The error figure of one's own louse, held against the server's own game.
#include "client/play/own_error.h"

#include <catch2/catch.hpp>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "client/play/spoken_words.h"
#include "shared/match/found_lice.h"
#include "shared/match/match.h"
#include "shared/match/step_error.h"
#include "staged_room.h"

namespace woodlouse::client {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kTickHz = 60;

/// A server's game of one player on volcano, and his room, over a line that takes `delay` frames of 50 ms.
class Game {
 public:
  explicit Game(std::size_t delay)
      : map_(volcano()),
        match_(map_, {.tick_hz = kTickHz, .seed = 3}),
        found_(*map_, 1.0 / kTickHz, state::Mode::kRoam),
        id_(match_.join()),
        up_(delay),
        down_(delay) {
    match_.advance();
    join();
  }

  void join() {
    protocol::Welcome message = welcome(*map_, id_);
    message.tick_hz = kTickHz;
    REQUIRE(room.on_message(message, now_));
    if (room.map() == nullptr)
      REQUIRE(
          room.on_message(protocol::MapMessage{map_->definition.name, map_->hash, map_->canonical}, now_));
  }

  /// One frame: what the server does in 50 ms, then the client's picture. push: a key goes down.
  std::optional<match::ErrorReading> frame(bool asked, bool push = false) {
    now_ += 50ms;
    for (int tick = 0; tick < 3; ++tick) step();
    down_.push_back({});
    std::swap(down_.back(), said_);
    for (const protocol::ServerMessage& message : down_.front()) REQUIRE(room.on_message(message, now_));
    down_.pop_front();
    if (push) room.pilot()->steering().push(now_);
    room.update(now_);
    const auto reading = own_error(room, asked);
    up_.push_back({});
    for (const protocol::ClientMessage& message : room.take_outgoing())
      if (const auto* input = std::get_if<protocol::Input>(&message)) up_.back().push_back(*input);
    for (const protocol::Input& input : up_.front()) file(input);
    up_.pop_front();
    return reading;
  }

  void respawn() {
    match_.respawn(id_);
    protocol::Event event;
    event.kind = protocol::EventKind::kRespawned;
    event.id = id_;
    event.tick = match_.tick();
    said_.emplace_back(event);
  }

  /// What the steps of the server's game erred that led to tick `end`, so many.
  [[nodiscard]] double truth(std::uint64_t end, std::uint64_t ticks) const {
    match::StepError error(*map_, 1.0 / kTickHz, state::Mode::kRoam);
    for (std::uint64_t tick = end - ticks; tick < end; ++tick) error.observe({&played_.at(tick), 1}, tick);
    return error.of_play(error.figures().at(id_));
  }

  RoomView room;

 private:
  void step() {
    const std::vector<state::Louse> before(match_.world().lice().begin(), match_.world().lice().end());
    const match::StepRecord& record = match_.advance();
    for (const state::Louse& louse : found_.find(before, record)) played_[record.tick] = louse;
    const state::Louse& own = *match_.world().find(id_);
    if (const auto ack = waiting_.find(record.tick); ack != waiting_.end()) {
      ack->second.you = protocol::ExactState{match_.tick(), own};
      said_.emplace_back(ack->second);
      waiting_.erase(ack);
    }
    if (match_.tick() % 3 != 0) return;
    std::vector<double> row(wanted_columns().size(), 0.0);
    row[0] = id_;
    said_.emplace_back(key(match_.tick(), row));
  }

  void file(const protocol::Input& input) {
    const match::Filed filed = match_.file({.player = id_,
                                            .seq = input.seq,
                                            .thrust = input.thrust,
                                            .ticks = input.ticks.value_or(state::kHeld),
                                            .wanted_tick = input.tick.value_or(0)});
    protocol::Ack ack;
    ack.seq = input.seq;
    ack.tick = filed.tick;
    ack.late = filed.late;
    waiting_[filed.tick] = ack;
  }

  std::shared_ptr<const map::Map> map_;
  match::Match match_;
  match::FoundLice found_;
  match::PlayerId id_;
  core::Time now_ = kStart;
  std::deque<std::vector<protocol::Input>> up_;
  std::deque<std::vector<protocol::ServerMessage>> down_;
  std::vector<protocol::ServerMessage> said_;
  std::map<std::uint64_t, protocol::Ack> waiting_;
  std::map<std::uint64_t, state::Louse> played_;  ///< as steps found it
};

std::uint64_t ticks_of(const match::ErrorReading& reading) {
  return static_cast<std::uint64_t>(reading.seconds * kTickHz + 0.5);
}

}  // namespace

TEST_CASE("the error figure is that of the game as the server played it, inputs that came late included") {
  for (const std::size_t delay : {0u, 3u}) {
    Game game(delay);
    for (int frame = 0; frame < 20; ++frame) game.frame(false);
    std::optional<match::ErrorReading> reading;
    std::uint64_t counted = 0;
    for (int frame = 0; frame < 300; ++frame) {
      reading = game.frame(true, frame % 7 == 0);
      if (frame < 15) CHECK_FALSE(reading);
      if (!reading) continue;
      CHECK(ticks_of(*reading) >= counted);
      counted = ticks_of(*reading);
    }
    REQUIRE(reading);
    CHECK(counted > 800);
    const std::uint64_t end = game.room.pilot()->prediction()->tick() - kTickHz;
    // Of an input that landed later than asked the few ticks between are those that were believed.
    CHECK(reading->of_play == Approx(game.truth(end, counted)).epsilon(delay == 0 ? 1e-12 : 1e-3));
    CHECK(reading->worst > 0.0);
    CHECK(reading->worst_tick < end);
  }
}

TEST_CASE("a respawn lets the error figure go on, and asked no more nothing of it is kept") {
  Game game(1);
  std::optional<match::ErrorReading> before;
  for (int frame = 0; frame < 100; ++frame) before = game.frame(true, frame % 7 == 0);
  REQUIRE(before);
  game.respawn();
  std::optional<match::ErrorReading> after;
  for (int frame = 0; frame < 100; ++frame) after = game.frame(true, frame % 7 == 0);
  REQUIRE(after);
  CHECK(ticks_of(*after) > ticks_of(*before) + 150);
  CHECK(ticks_of(*after) < ticks_of(*before) + 300);
  CHECK(after->worst >= before->worst);

  CHECK_FALSE(game.frame(false));
  CHECK(game.room.pilot()->prediction()->error() == nullptr);
  CHECK_FALSE(game.frame(true));
}

TEST_CASE("another session begins the error figure anew, and while there is none nothing is known") {
  Game game(0);
  std::optional<match::ErrorReading> before;
  for (int frame = 0; frame < 100; ++frame) before = game.frame(true, frame % 7 == 0);
  REQUIRE(before);
  game.room.on_lost();
  CHECK_FALSE(has_error(game.room));
  CHECK_FALSE(own_error(game.room, true));
  game.join();
  REQUIRE(has_error(game.room));
  CHECK_FALSE(game.frame(true));
  std::optional<match::ErrorReading> after;
  for (int frame = 0; frame < 60; ++frame) after = game.frame(true, frame % 7 == 0);
  REQUIRE(after);
  CHECK(ticks_of(*after) < ticks_of(*before));
}

TEST_CASE("the error figure is read out with its units, and who watches hears why there is none") {
  const match::ErrorReading reading{15.0, 3.12e-6, 2.04e-4, 812, 1.2e-3, 10.0};
  CHECK(words::error(reading) ==
        "error 3.1e-06 m/s of play, worst 2.0e-04 m at tick 812; twin at half the step 1.2e-03 m away after "
        "10 s");
  const RoomView room;
  CHECK(words::no_error(room) == "only of your own louse the error is known");
}

}  // namespace woodlouse::client
