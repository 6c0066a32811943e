// Everything a match at one tick needs to go on from there, bit for bit: what a keyframe holds.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "shared/map/map_definition.h"
#include "shared/match/input_queue.h"
#include "shared/state/louse.h"
#include "shared/state/role.h"
#include "shared/state/state_hash.h"

namespace woodlouse::match {

/// Who plays a louse. The name as it is shown: UTF-8 of at most 4096 bytes, or no recording has it as it was
/// hashed; cleaned where it came from outside.
struct PlayerLabel {
  std::string name;
  state::Role role = state::Role::kPlayer;
  friend bool operator==(const PlayerLabel&, const PlayerLabel&) = default;
};
using PlayerLabels = std::map<state::LouseId, PlayerLabel>;

/// The numbers are hashed.
enum class RosterAction : std::uint32_t { kJoin = 1, kLeave = 2, kRespawn = 3, kRespawnAtGate = 4 };

/// A change of who plays, as applied in a step.
struct RosterChange {
  RosterAction action = RosterAction::kJoin;
  state::LouseId player = 0;
  PlayerLabel label{};  ///< of a join
  friend bool operator==(const RosterChange&, const RosterChange&) = default;
};

/// What a hash takes of them: XXH64 over, for each, action, player, role and the number of the name's bytes
/// (32 bits each), then the name.
std::uint64_t roster_hash(core::StableHasher& hasher, std::span<const RosterChange> changes);

struct MatchState {
  std::uint64_t tick = 0;
  std::uint64_t hash = 0;             ///< of this tick; 0 before the first step that did something
  state::HashLink link;               ///< what went into it besides the lice
  state::LouseId next_player = 1;     ///< above every id used so far
  std::vector<PlayerSeq> players;     ///< who may file inputs, by ascending id
  PlayerLabels labels;                ///< of each of them
  std::vector<AppliedInput> waiting;  ///< filed for this tick or later, by (tick, player, seq)
  std::vector<RosterChange> roster;   ///< queued for the next step, in the order they came
  std::vector<state::Louse> lice;     ///< by ascending id
  std::string rules{};  ///< the rules' (rules/rules.h); empty: there are none, or nothing has happened
};

/// Who has joined, ascending: those of its players for whom no join is queued, and those for whom a leave is.
std::vector<state::LouseId> ids_on_roster(const MatchState& state);

struct MatchSettings;

/// The link of a match in which no step has done anything.
state::HashLink beginning(const MatchSettings& settings);

/// Why no match on that map can be in that state, for states that came from outside; empty: one can. Checks
/// the order of every list, that players, lice and inputs belong together, that numbers are finite and places
/// on the map, and that the hash is that of the state.
std::string why_not(const map::Map& map, const MatchSettings& settings, const MatchState& state);

}  // namespace woodlouse::match
