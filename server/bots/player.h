// One of the house's bots that plays by a mode's rules: it looks at frames and pushes. It files inputs like
// everyone else; nothing of it is in the simulation, so it may use libm. Pure: no clock, no socket.
#pragma once

#include <cstdint>
#include <vector>

#include "server/bots/foresight.h"
#include "server/bots/game_view.h"
#include "server/bots/skill.h"
#include "shared/core/random.h"

namespace woodlouse::server::bots {

/// What a bot looks at when its turn has come.
struct Scene {
  const GameView& seen;  ///< at least its reaction old
  std::size_t own;       ///< its place in seen.lice
  std::uint64_t tick;    ///< the step that will take what it does
  double tick_s;         ///< [s]
};

struct Order {
  state::Thrust thrust;   ///< until the next: a map vector of length at most 1, in multiples of 1/128
  bool respawns = false;  ///< back to a spawn; the thrust is nothing
};

class Player {
 public:
  Player(Skill skill, std::uint64_t seed) : ability_(bots::ability(skill)), random_(seed) {}
  virtual ~Player() = default;
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  [[nodiscard]] const Ability& ability() const { return ability_; }
  /// foresight: of the same map.
  Order decide(const Scene& scene, Foresight& foresight);

 protected:
  struct Choice {
    core::Vec2 push;
    bool respawns = false;
  };
  virtual Choice choose(const Scene& scene, Foresight& foresight) = 0;

  /// What the foresight needs to know of this one.
  [[nodiscard]] Foresight::Question ask(const Scene& scene, std::span<const Goal> goals) const;
  core::Random& random() { return random_; }

 private:
  Ability ability_;
  core::Random random_;
  std::vector<Push> pushes_;  ///< the last, by time; from the one on that acted when the last frame was made
};

}  // namespace woodlouse::server::bots
