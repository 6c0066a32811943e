// After crumbs: the one that is worth most for the way there,
//     value / (distance + 3 max(0, climb / s - v^2 / 2g)),
// s the slope that full thrust climbs from rest, v the speed of the run-up.
#pragma once

#include <optional>
#include <span>

#include "server/bots/patience.h"
#include "server/bots/player.h"

namespace woodlouse::server::bots {

class Forager final : public Player {
 public:
  /// radius: within which a crumb is eaten [m].
  Forager(double radius, Skill skill, std::uint64_t seed)
      : Player(skill, seed), radius_(radius), skill_(skill) {}

 private:
  Choice choose(const Scene& scene, Foresight& foresight) override;
  /// Points for a metre, about, of a crumb for a louse there.
  [[nodiscard]] static double worth(const Effort& effort, const state::Louse& louse, const Crumb& crumb);
  [[nodiscard]] std::optional<core::Vec2> best(const Scene& scene, const Effort& effort,
                                               const state::Louse& louse, std::optional<core::Vec2> besides);

  double radius_;
  Skill skill_;
  std::optional<core::Vec2> target_;      ///< [m]
  std::optional<core::Vec2> left_alone_;  ///< what it has tried in vain [m]
  std::uint64_t left_alone_until_ = 0;    ///< [ticks]
  Patience patience_;
};

}  // namespace woodlouse::server::bots
