#include "server/relay/playout.h"

#include <algorithm>
#include <cassert>

namespace woodlouse::server {

Playout::Playout(std::uint32_t tick_hz, Duration delay) : tick_hz_(tick_hz), delay_(delay) {
  assert(tick_hz_ >= 1 && delay_ >= Duration{});
}

/// Whole seconds apart: ticks times nanoseconds would not fit after some years.
Duration Playout::after(std::uint64_t ticks) const {
  assert(is_of_a_game(ticks));
  constexpr std::uint64_t kSecond = std::chrono::nanoseconds(std::chrono::seconds(1)).count();
  const std::uint64_t rest = ticks % tick_hz_ * kSecond / tick_hz_;
  return std::chrono::duration_cast<Duration>(
      std::chrono::seconds(ticks / tick_hz_) +
      std::chrono::nanoseconds(static_cast<std::chrono::nanoseconds::rep>(rest)));
}

void Playout::came(std::uint64_t tick, Time now) {
  if (!is_of_a_game(tick)) return;
  const Time seen = now - after(tick);
  const bool is_first = !origin_;
  if (is_first || seen <= *origin_ || seen - *origin_ > kStood) {
    origin_ = seen;
    late_parts_ = 0;
    return;
  }
  if (seen - *origin_ < kLate) {
    late_parts_ = 0;
    return;
  }
  best_late_ = late_parts_ == 0 ? seen : std::min(best_late_, seen);
  if (++late_parts_ < kLateParts) return;
  origin_ = best_late_;
  late_parts_ = 0;
}

Time Playout::due(std::uint64_t tick) const {
  if (!origin_ || !is_of_a_game(tick)) return Time::min();
  return *origin_ + after(tick) + delay_;
}

}  // namespace woodlouse::server
