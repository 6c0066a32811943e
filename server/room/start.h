// What a room's game begins from: an empty match, or a tick of a recording (commands/fork.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/bots/team.h"
#include "server/room/seats.h"
#include "shared/match/match.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

struct Start {
  std::shared_ptr<const map::Map> map;
  std::unique_ptr<match::Match> match;  ///< on that map; nothing is queued in it
  std::string map_file;                 ///< where the map is, for recordings
  std::vector<Seat> unclaimed;          ///< by louse, Nobody's or Vacant; they have one each
  std::optional<replay::Parent> parent;
  std::string on_trust{};  ///< of a parent's tick, what no re-run proves, for the log; empty: nothing
  /// The house's bots that play the match's rules. Null: there are no rules, or the room makes it, which on a
  /// long course takes seconds of its ticks.
  std::unique_ptr<bots::Team> team{};
};

/// Of a game that goes on, by louse: nobody sits there yet. A louse that nobody named can't be asked for.
std::vector<Seat> unclaimed_seats(const match::Match& match);

/// Inputs are counted anew from here on, or who sent the last one there is a number for is never heard again:
/// those that wait come first.
match::MatchState counted_anew(match::MatchState state);

}  // namespace woodlouse::server
