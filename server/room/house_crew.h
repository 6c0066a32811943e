// The house's own bots of a room, which look and push in turns: no tick pays for all of them. Where there are
// no rules they are the four characters (house_bots.h); else they play by the rules (bots/team.h). The room's
// strand owns it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "server/bots/skill.h"
#include "server/bots/team.h"
#include "server/room/seats.h"
#include "shared/match/match.h"

namespace woodlouse::server {

class HouseCrew {
 public:
  /// Before the first take() of a game: for so many, who play its mode as well as that. Who was here is not
  /// any more. team: of that game, and as many; null: it is made here, where one is needed.
  void reserve(std::uint32_t bots, const match::Match& game, bots::Skill skill,
               std::unique_ptr<bots::Team> team);
  /// Of the one with that number and that bot of the four characters.
  [[nodiscard]] std::string name_of(std::uint32_t number, const HouseBot& bot) const;
  /// One more. The seat is a bot's and stays where it is.
  void take(Seat& seat);
  /// Before each tick: those whose turn it is. Who went back to a spawn; valid until the next call.
  std::span<Seat* const> steer(match::Match& game);

 private:
  void roam(match::Match& game);

  std::vector<std::vector<Seat*>> by_turn_;  ///< of roam: by the tick of a period at which they look
  std::unique_ptr<bots::Team> team_;         ///< of a mode with rules
  state::Mode mode_ = state::Mode::kRoam;
  std::map<match::PlayerId, Seat*> seats_;  ///< of the team
  std::vector<Seat*> respawned_;
};

}  // namespace woodlouse::server
