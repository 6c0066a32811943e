// When a bot that comes no nearer tries something else: it swings for a while.
#pragma once

#include <cstdint>

#include "shared/core/random.h"

namespace woodlouse::server::bots {

class Patience {
 public:
  static constexpr double kLasts = 4.0;       ///< without coming nearer [s]
  static constexpr double kLeastSwing = 1.5;  ///< how long it swings [s]
  static constexpr double kMoreSwing = 3.0;   ///< and so much more, by chance [s]

  /// A new goal.
  void begin(std::uint64_t tick) {
    since_ = tick;
    is_begun_ = false;
  }
  /// way: how much of it is left; nearer: what is worth a mention, of the same unit. True: it is to swing.
  bool is_out(std::uint64_t tick, double tick_s, double way, double nearer, core::Random& random) {
    const auto ticks = [tick_s](double seconds) { return static_cast<std::uint64_t>(seconds / tick_s); };
    if (tick < swings_until_) {
      begin(tick);
      return true;
    }
    if (!is_begun_ || way < least_ - nearer) {
      least_ = way;
      since_ = tick;
      is_begun_ = true;
    }
    if (tick - since_ < ticks(kLasts)) return false;
    swings_until_ = tick + ticks(kLeastSwing + kMoreSwing * random.uniform());
    return true;
  }

 private:
  bool is_begun_ = false;
  double least_ = 0.0;              ///< way since the goal is
  std::uint64_t since_ = 0;         ///< when that was [ticks]
  std::uint64_t swings_until_ = 0;  ///< [ticks]
};

}  // namespace woodlouse::server::bots
