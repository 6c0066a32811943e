// Whether somebody is still there: what has been heard of a client, and what follows from nothing.
// Pure: time is an argument. One owner, no locking.
#pragma once

#include <algorithm>
#include <chrono>

#include "server/timing/clock.h"
#include "shared/protocol/limits.h"

namespace woodlouse::server {

/// A client that has answered a ping answers all: silence of vacant_s means that nobody steers any more, and
/// of resume_s more that nobody comes back. Of who never has (a watcher through nc) silence means nothing
/// while what it is sent arrives: idle_s counts from the last byte either way.
class Pulse {
 public:
  Pulse(const protocol::Limits& limits, Time now)
      : ping_every_(std::chrono::seconds(limits.ping_s)),
        vacant_after_(std::chrono::seconds(limits.vacant_s)),
        gone_after_(std::chrono::seconds(limits.vacant_s + limits.resume_s)),
        idle_after_(std::chrono::seconds(limits.idle_s)),
        heard_(now),
        active_(now),
        pinged_(now) {}

  /// A line has come; is_pong: the answer to a ping.
  void hear(Time now, bool is_pong) {
    heard_ = active_ = now;
    answers_ = answers_ || is_pong;
    is_vacant_ = false;
  }
  /// A write has gone out.
  void sent(Time now) { active_ = now; }

  enum class Sign { kNone, kPing, kVacant, kIdle };
  /// What is due at `now`; asked again until nothing is. kIdle comes once nothing will change it.
  Sign due(Time now) {
    if (now >= idle_until()) return Sign::kIdle;
    if (answers_ && !is_vacant_ && now >= heard_ + vacant_after_) {
      is_vacant_ = true;
      return Sign::kVacant;
    }
    if (now < pinged_ + ping_every_) return Sign::kNone;
    pinged_ = now;
    return Sign::kPing;
  }
  [[nodiscard]] bool answers() const { return answers_; }
  /// When something will be due, if nothing is heard or sent till then.
  [[nodiscard]] Time next() const {
    Time next = std::min(idle_until(), pinged_ + ping_every_);
    if (answers_ && !is_vacant_) next = std::min(next, heard_ + vacant_after_);
    return next;
  }

 private:
  [[nodiscard]] Time idle_until() const {
    return answers_ ? std::min(heard_ + gone_after_, active_ + idle_after_) : active_ + idle_after_;
  }

  Duration ping_every_, vacant_after_, gone_after_, idle_after_;
  Time heard_;   ///< the last line
  Time active_;  ///< the last line, or a write that went out
  Time pinged_;
  bool answers_ = false;
  bool is_vacant_ = false;
};

}  // namespace woodlouse::server
