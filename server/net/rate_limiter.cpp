#include "server/net/rate_limiter.h"

namespace woodlouse::server {

RateLimiter::Verdict RateLimiter::take(Time now) {
  if (messages_.take(1.0, now)) return Verdict::kPass;
  return refusals_.take(1.0, now) ? Verdict::kRefuse : Verdict::kFlood;
}

}  // namespace woodlouse::server
