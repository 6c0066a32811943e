#include "client/net/server_clock.h"

#include <algorithm>
#include <cmath>

namespace woodlouse::client {

double ServerClock::elapsed(core::Time now) const {
  return std::chrono::duration<double>(now - origin_).count();
}

void ServerClock::observe(std::uint64_t tick, core::Time arrival) {
  if (!running_) {
    running_ = true;
    origin_ = last_observed_ = last_shown_ = arrival;
    line_ = shown_ = latest_ = static_cast<double>(tick);
    return;
  }
  const double seen = static_cast<double>(tick) - elapsed(arrival) * tick_hz_;
  const double pause = std::max(0.0, std::chrono::duration<double>(arrival - last_observed_).count());
  last_observed_ = arrival;
  line_ = std::max(seen, line_ - kSinkSeconds * pause * tick_hz_);
  if (line_ - seen < kLateSeconds * tick_hz_) {
    late_frames_ = 0;
    return;
  }
  best_late_ = late_frames_ == 0 ? seen : std::max(best_late_, seen);
  if (++late_frames_ >= kLateFrames) {
    line_ = best_late_;
    late_frames_ = 0;
  }
}

double ServerClock::tick(core::Time now) {
  const double pause = std::max(0.0, std::chrono::duration<double>(now - last_shown_).count());
  last_shown_ = std::max(last_shown_, now);
  const double gap = line_ - shown_;
  if (std::abs(gap) > kJump * tick_hz_) {
    shown_ = line_;
    latest_ = shown_ + elapsed(now) * tick_hz_;
    return latest_;
  }
  const double most = kSlew * pause * tick_hz_;
  shown_ += std::clamp(gap, -most, most);
  latest_ = std::max(latest_, shown_ + elapsed(now) * tick_hz_);
  return latest_;
}

}  // namespace woodlouse::client
