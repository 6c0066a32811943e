// The house's bots of a room that play its mode: who looks and pushes when. They see frames as a client gets
// them, with a delay, and each has a random stream of its own. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "server/bots/foresight.h"
#include "server/bots/game_view.h"
#include "server/bots/player.h"
#include "server/bots/route.h"
#include "server/bots/skill.h"
#include "shared/match/match.h"

namespace woodlouse::server::bots {

/// By its number, from 0.
std::string player_name(state::Mode mode, std::uint32_t number);

class Team {
 public:
  /// map: outlives it. bots: how many it will be. REQUIRES a mode with rules that the map has.
  Team(const map::Map& map, const match::MatchSettings& settings, Skill skill, std::uint32_t bots);

  /// One more, which steers that louse. next_seq: under which its next input is filed; it is counted up.
  void take(match::PlayerId louse, std::uint32_t number, std::uint32_t& next_seq);
  /// Before each tick. Who respawned; valid until the next call.
  std::span<const match::PlayerId> steer(match::Match& game);

 private:
  struct Member {
    match::PlayerId louse;
    std::uint32_t* next_seq;
    std::unique_ptr<Player> player;
    std::uint64_t every;            ///< ticks between its decisions
    std::uint64_t turn;             ///< the tick of a period at which it looks
    std::uint64_t delay;            ///< [ticks]
    std::uint64_t blind_until = 0;  ///< it sees nothing of before its own respawn
  };
  [[nodiscard]] std::unique_ptr<Player> make(std::uint32_t number) const;
  void steer(match::Match& game, Member& member);

  const map::Map& map_;
  match::MatchSettings settings_;
  Skill skill_;
  Foresight foresight_;
  std::unique_ptr<const Route> route_;  ///< of a race
  Sight sight_;
  std::vector<Member> members_;
  std::vector<match::PlayerId> respawned_;
};

}  // namespace woodlouse::server::bots
