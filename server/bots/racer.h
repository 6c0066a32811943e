// Through the gates as fast as it can: it aims at the next gate with a look at those behind it, brakes for
// bends, and where a hill is too steep for its thrust it swings or takes a run-up (foresight.h).
#pragma once

#include "server/bots/patience.h"
#include "server/bots/player.h"
#include "server/bots/route.h"

namespace woodlouse::server::bots {

class Racer final : public Player {
 public:
  /// After so long without a gate it begins anew [s].
  static constexpr double kGivesUpAfter = 30.0;

  /// route: outlives it.
  Racer(const Route& route, Skill skill, std::uint64_t seed) : Player(skill, seed), route_(route) {}

 private:
  Choice choose(const Scene& scene, Foresight& foresight) override;

  const Route& route_;
  std::uint32_t gate_ = 0;   ///< the next, as last seen
  std::uint64_t since_ = 0;  ///< the tick from which on it is
  Patience patience_;
};

}  // namespace woodlouse::server::bots
