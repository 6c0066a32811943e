// A room as a server tells of it: a map, its welcome, keys of one louse.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "client/play/room_view.h"
#include "shared/map/map_file.h"

namespace woodlouse::client {

inline const core::Time kStart{std::chrono::seconds(100)};

inline std::shared_ptr<const map::Map> volcano() {
  auto loaded = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  REQUIRE(loaded);
  return *loaded;
}

inline protocol::Welcome welcome(const map::Map& map, std::uint32_t id) {
  protocol::Welcome message;
  message.id = id;
  message.fields = wanted_columns();
  message.map_hash = map.hash;
  message.map_name = map.definition.name;
  message.extent = {-20, -20, 20, 20};
  message.players = {{1, "ada", protocol::Role::kPlayer}, {2, "gauss", protocol::Role::kBot}};
  return message;
}

inline protocol::Frame key(std::uint64_t tick, std::vector<double> values) {
  protocol::Frame frame;
  frame.tick = frame.base = tick;
  frame.columns = wanted_columns().size();
  frame.values = std::move(values);
  return frame;
}

template <typename Message>
std::size_t count(const std::vector<protocol::ClientMessage>& messages) {
  std::size_t found = 0;
  for (const auto& message : messages) found += std::holds_alternative<Message>(message) ? 1 : 0;
  return found;
}

}  // namespace woodlouse::client
