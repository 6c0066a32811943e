// What the rules have said of your own louse lately: what is told in big figures, the chain of crumbs, when
// the race's run began. Time is an argument. Single thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "client/drawing/course/course.h"
#include "client/play/view_state.h"
#include "shared/core/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

class OwnRun {
 public:
  static constexpr std::chrono::milliseconds kSplashFor{2000};
  static constexpr double kChainSeconds = 4.0;

  /// An event of the rules about louse `you`; others are passed over.
  void event(const protocol::Event& event, std::uint32_t you, std::uint32_t tick_hz, core::Time now);
  /// A lap through a gate of one's own [s].
  void own_lap(double seconds, bool is_best, core::Time now);
  /// What a frame says of it.
  void observe(const Standing& standing);
  void forget() { *this = OwnRun(); }

  /// What stands big over the picture now.
  [[nodiscard]] std::optional<Splash> splash(core::Time now) const;
  /// How often the last crumb counted; 0: no chain at this tick.
  [[nodiscard]] std::int64_t chain(double tick, std::uint32_t tick_hz) const;
  /// How much of the chain's time is left, 1..0.
  [[nodiscard]] double chain_left(double tick, std::uint32_t tick_hz) const;
  /// When the race's run began [moment]; 0: the clock does not run, or nobody knows.
  [[nodiscard]] std::int64_t run_start() const { return run_start_; }

 private:
  void show(std::string text, Tone tone, core::Time now);

  Splash splash_;
  std::optional<core::Time> splashed_;
  std::int64_t chain_ = 0;
  std::uint64_t chain_at_ = 0;  ///< moment
  std::int64_t run_start_ = 0;
};

}  // namespace woodlouse::client
