// The lice on their map at one moment, wherever they come from: what scenes and words are made of.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "client/play/pilot.h"
#include "client/play/trail.h"
#include "client/play/view_state.h"
#include "shared/map/map_definition.h"
#include "shared/protocol/game.h"
#include "shared/state/mode.h"

namespace woodlouse::client {

/// A louse as it is drawn, and whose it is.
struct Present {
  LouseSample sample;
  std::string name;
  bool is_bot = false;
  bool is_you = false;
};

/// What the rules of play show, and when.
struct Ruling {
  state::Mode mode = state::Mode::kRoam;
  const protocol::Game* game = nullptr;  ///< whole; null: there are no rules, or nothing was shown yet
  double tick = 0.0;                     ///< now
  std::uint32_t tick_hz = 60;
  std::uint64_t author_ms = 0;  ///< of a race, the time to beat; 0: none is known. No part of the map's hash
};

/// Refers to what a room view or a recording's view holds; valid until that runs on.
struct Sight {
  const map::Map* map = nullptr;                 ///< null until it has come
  const std::map<std::uint32_t, Present>& lice;  ///< by id
  const std::map<std::uint32_t, Trail>& trails;
  const Pilot* pilot = nullptr;  ///< of your own louse; null without one
  Ruling ruling{};
  std::function<std::string(std::uint32_t)>
      name_of{};                                ///< of any louse, seen or not; set where there are rules
  std::function<bool(std::uint32_t)> is_bot{};  ///< of any louse, as name_of
  bool is_part = false;                         ///< there are lice that are not seen
};

}  // namespace woodlouse::client
