// A host's shard, and who shows its room.
#pragma once

#include <catch2/catch.hpp>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/relay/relay_room.h"
#include "shared/core/stable_hash.h"
#include "tests/server/cluster/logged_room.h"
#include "tests/server/room/house.h"

namespace woodlouse::server::test {

using std::chrono::milliseconds;

inline constexpr Duration kDelay = milliseconds(150);

inline protocol::Limits some_places(std::uint32_t spectators) {
  protocol::Limits limits;
  limits.max_spectators = spectators;
  return limits;
}

inline protocol::Join watching(const std::string& name, protocol::Stream stream = protocol::Stream::kFrames) {
  protocol::Join join;
  join.role = protocol::Role::kSpectator;
  join.stream = stream;
  join.name = name;
  return join;
}

struct Edge : Contexts {
  explicit Edge(std::uint32_t spectators = 8) : limits(some_places(spectators)) { read(shard); }

  /// From now on the log is that one's.
  void read(Shard& writer) {
    source = &writer;
    ShardView::Reader reader;
    reader.line = [this](const std::string&, std::string_view line) { lines.emplace_back(line); };
    reader.closed = [](const std::string&) {};
    view.emplace(std::move(reader));
  }
  /// The room plays so many steps, which come together.
  void play(int steps) {
    for (int k = 0; k < steps; ++k) {
      source->step();
      hashes[source->game->tick()] = core::to_hex(source->game->hash());
    }
    come();
  }
  void come() {
    source->cut();
    const auto taken = view->take(source->first + source->batches.size() - 1, source->batches.back());
    if (!taken) FAIL(taken.error().text());
    room->take(std::exchange(lines, {}));
    settle();
  }
  void pass(Duration time) {
    for (Duration left = time; left > Duration{}; left -= milliseconds(5)) {
      timekeeper.advance(milliseconds(5));
      settle();
    }
  }
  /// So many parts of six steps, 100 ms from one to the next.
  void go_on(int parts) {
    for (int k = 0; k < parts; ++k) {
      play(6);
      pass(milliseconds(100));
    }
  }
  std::shared_ptr<Guest> join(SessionId session, protocol::Join wanted) {
    return Contexts::join(*room->door(), session, std::move(wanted));
  }

  RoomSettings settings() const {
    RoomSettings result;
    result.name = "volcano";
    return result;
  }

  ManualTimekeeper timekeeper;
  LiveLimits limits;
  Shard shard;
  Shard* source = nullptr;
  std::optional<ShardView> view;
  std::vector<std::string> lines;
  std::map<std::uint64_t, std::string> hashes;
  MapShelf maps;
  int times_ready = 0;
  std::string lost;
  std::shared_ptr<RelayRoom> room = std::make_shared<RelayRoom>(
      ticks, lanes, settings(), limits, kDelay, timekeeper, maps,
      RelayRoom::Hooks{[this] { ++times_ready; }, [this](const std::string& why) { lost = why; }});
};

}  // namespace woodlouse::server::test
