#include "server/timing/tick_clock.h"

#include <cassert>

namespace woodlouse::server {

Duration TickClock::offset(std::uint64_t ticks) const {
  // Whole seconds apart from the rest: no overflow within centuries and no rounding that adds up.
  const auto seconds = std::chrono::seconds(ticks / tick_hz_);
  const auto rest = std::chrono::nanoseconds((ticks % tick_hz_) * 1'000'000'000u / tick_hz_);
  return std::chrono::duration_cast<Duration>(seconds + rest);
}

void TickClock::restart(Time now) {
  origin_ = now;
  begun_ = 0;
}

Duration TickClock::begin(Time now) {
  const Duration late = now - deadline();
  assert(late >= Duration::zero());
  if (late > offset(kMaxLateTicks)) {
    restart(now);
    ++moves_;
  }
  ++begun_;
  return late;
}

}  // namespace woodlouse::server
