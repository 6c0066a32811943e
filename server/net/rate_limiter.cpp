#include "server/net/rate_limiter.h"

#include <algorithm>
#include <cmath>

namespace woodlouse::server {

bool TokenBucket::take(double cost, Time now) {
  if (now > at_) {
    tokens_ = std::min(burst_, tokens_ + rate_ * std::chrono::duration<double>(now - at_).count());
    at_ = now;
  }
  if (tokens_ < cost) return false;
  tokens_ -= cost;
  return true;
}

Duration TokenBucket::wait(double cost) const {
  const double missing = std::max(0.0, cost - tokens_);
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(missing / rate_));
}

RateLimiter::Verdict RateLimiter::take(Time now, double cost) {
  if (messages_.take(cost, now)) return Verdict::kPass;
  return refusals_.take(1.0, now) ? Verdict::kRefuse : Verdict::kFlood;
}

std::uint32_t RateLimiter::retry_after_ms(double cost) const {
  const auto ms = std::chrono::duration<double, std::milli>(messages_.wait(cost)).count();
  return static_cast<std::uint32_t>(std::max(1.0, std::ceil(ms)));
}

}  // namespace woodlouse::server
