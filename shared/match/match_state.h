// Everything a match at one tick needs to go on from there, bit for bit: what a keyframe holds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/map/map_definition.h"
#include "shared/match/input_queue.h"
#include "shared/state/louse.h"

namespace woodlouse::match {

enum class RosterAction : std::uint32_t { kJoin = 0, kLeave = 1, kRespawn = 2 };

/// A change of who plays, as applied in a step.
struct RosterChange {
  RosterAction action = RosterAction::kJoin;
  state::LouseId player = 0;
  friend bool operator==(const RosterChange&, const RosterChange&) = default;
};

struct MatchState {
  std::uint64_t tick = 0;
  std::uint64_t hash = 0;      ///< of this tick; 0 at tick 0
  std::uint64_t previous = 0;  ///< the hash of the tick before
  std::uint64_t inputs = 0;    ///< the hash of the inputs that led here
  std::uint64_t generator = 0;
  state::LouseId next_player = 1;     ///< above every id used so far
  std::vector<PlayerSeq> players;     ///< who may file inputs, by ascending id
  std::vector<AppliedInput> waiting;  ///< filed for this tick or later, by (tick, player, seq)
  std::vector<RosterChange> roster;   ///< queued for the next step, in the order they came
  std::vector<state::Louse> lice;     ///< by ascending id
};

struct MatchSettings;

/// Why no match on that map can be in that state, for states that came from outside; empty: one can. Checks
/// the order of every list, that players, lice and inputs belong together, that numbers are finite and places
/// on the map, and that the hash is that of the state.
std::string why_not(const map::Map& map, const MatchSettings& settings, const MatchState& state);

}  // namespace woodlouse::match
