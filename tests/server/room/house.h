// A room without a port, whose time a test moves, and guests that keep what they are told.
#pragma once

#include <catch2/catch.hpp>

#include <spdlog/sinks/null_sink.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/room/room.h"
#include "shared/map/map_file.h"
#include "tests/server/timing/manual_timekeeper.h"

namespace woodlouse::server::test {

/// Keeps what a room says to it.
class Guest final : public Subscriber {
 public:
  [[nodiscard]] std::size_t lane() const override { return 0; }
  void deliver(Line line) override {
    const std::string& text = *line;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end) {
      end = text.find('\n', at) + 1;
      lines.push_back(text.substr(at, end - at));
    }
  }
  void answer(protocol::ServerMessage message) override {
    if (std::holds_alternative<protocol::Ack>(message)) order.push_back('a');
    answers.push_back(std::move(message));
  }
  void show(const Frame& frame) override {
    order.push_back('f');
    frames.push_back(frame);
  }
  void show_again(const Frame& frame) override {
    frames.push_back(frame);
    again.push_back(frame);
  }
  void follow(const StreamPart& part) override { parts.push_back(part); }
  void deliver_map(Line line) override { maps.push_back(*line); }
  void refuse_join(protocol::ErrorMessage error) override { refusals.push_back(std::move(error)); }
  void welcome(protocol::Welcome message, std::uint32_t every) override {
    welcomes.push_back(std::move(message));
    frames_at_welcome.push_back(frames.size());
    divisor = every;
  }
  void let_go() override { ++times_let_go; }
  void end(protocol::Bye bye) override { byes.push_back(std::move(bye)); }

  std::vector<std::string> lines, maps;
  std::vector<protocol::ServerMessage> answers;
  std::vector<Frame> frames;
  std::vector<Frame> again;  ///< of them, those out of turn
  std::vector<StreamPart> parts;
  std::vector<protocol::ErrorMessage> refusals;
  std::vector<protocol::Welcome> welcomes;
  std::vector<protocol::Bye> byes;
  std::vector<std::size_t> frames_at_welcome;  ///< how many had come before each
  std::uint32_t divisor = 0;
  int times_let_go = 0;
  std::string order;  ///< of acks (a) and frames (f)
};

/// What rooms run on, by hand.
struct Contexts {
  static std::shared_ptr<const map::Map> load() {
    auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
    REQUIRE(map);
    return *map;
  }

  static Start open() {
    const auto map = load();
    return {
        map, std::make_unique<match::Match>(map, match::MatchSettings{60, 0}), "maps/volcano.json", {}, {}};
  }

  /// Until nothing is left to do now.
  void settle() {
    while (ticks.poll() + io.poll() > 0) {
      ticks.restart();
      io.restart();
    }
    ticks.restart();
    io.restart();
  }

  std::shared_ptr<Guest> join(Door& door, SessionId session, protocol::Join join = {}) {
    auto guest = std::make_shared<Guest>();
    if (join.fields.empty()) join.fields = protocol::default_columns();
    if (join.name.empty()) join.name = "guest" + std::to_string(session);
    door.join({session, guest, join, address_of(session), Time{}});
    settle();
    return guest;
  }

  /// Each has one of its own, unless a test says otherwise.
  std::function<AddressId(SessionId)> address_of = [](SessionId session) { return session; };
  boost::asio::io_context io{1}, ticks{1};  // rooms, which ticks may hold, end before io
  Lanes lanes{io, 1};
  std::shared_ptr<spdlog::logger> log =
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>());
};

/// A room whose timer has not begun: what it does between two ticks.
struct House : Contexts {
  explicit House(RoomSettings settings, Start start = open(), Watchers watchers = {},
                 Rotation* rotation = nullptr)
      : room(Room::make(ticks, lanes, std::move(settings), std::move(start), std::move(watchers), timekeeper,
                        log, rotation)),
        door(room->door()) {}

  std::shared_ptr<Guest> join(SessionId session, protocol::Join wanted = {}) {
    return Contexts::join(*door, session, std::move(wanted));
  }

  /// So many ticks of 60 a second; the first one after start() is due at once.
  void tick(int times = 1) {
    for (int k = 0; k < times; ++k) {
      settle();
      if (std::exchange(ticked_, true)) timekeeper.advance(std::chrono::nanoseconds(16'666'667));
      settle();
    }
  }

  ManualTimekeeper timekeeper;
  std::shared_ptr<Room> room;
  std::shared_ptr<Door> door;

 private:
  bool ticked_ = false;
};

/// So many players, and as many of the other two.
inline RoomSettings settings(std::uint32_t per_room) {
  RoomSettings result;
  result.name = "volcano";
  result.limits.max_players = result.limits.max_bots = result.limits.max_spectators = per_room;
  result.adopts_by_name = true;
  return result;
}

/// A game that goes on after two players pushed: mara by her input 17, the other one, a bot, by none.
inline Start went_on() {
  Start start = House::open();
  const match::PlayerId mara = start.match->join();
  const match::PlayerId rolly = start.match->join();
  start.match->file({mara, 17, {state::ThrustKind::kAlongHeading, {0.5, 0.0}}, state::kHeld, 0});
  start.match->advance();
  start.unclaimed.push_back({mara, "mara", protocol::Role::kPlayer, 18, Nobody{}});
  start.unclaimed.push_back({rolly, "Rolly", protocol::Role::kBot, 0, Nobody{}});
  return start;
}

inline protocol::Join named(const std::string& name, protocol::Role role = protocol::Role::kPlayer) {
  protocol::Join join;
  join.name = name;
  join.role = role;
  return join;
}

}  // namespace woodlouse::server::test
