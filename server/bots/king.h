// To the place that counts, and it stays there. Who else is on it, it runs into from within; where that does
// not help, it goes back for a run-up and charges.
#pragma once

#include "server/bots/patience.h"
#include "server/bots/player.h"

namespace woodlouse::server::bots {

class King final : public Player {
 public:
  King(Skill skill, std::uint64_t seed) : Player(skill, seed) {}

 private:
  Choice choose(const Scene& scene, Foresight& foresight) override;

  enum class Plan { kStay, kGoBack, kCharge };
  void make_plan(const Scene& scene, std::size_t rivals);

  Plan plan_ = Plan::kStay;
  std::uint64_t plan_until_ = 0;  ///< the tick at which the next one is made
  core::Vec2 place_;              ///< where it was heading [m]
  Patience patience_;
};

}  // namespace woodlouse::server::bots
