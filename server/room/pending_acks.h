// Inputs that were filed and whose step has not run: who is to be told, and what.
// Pure. The room's strand owns it; bounded by the match's InputQueue::kMaxPending per player.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "server/room/clock.h"
#include "server/room/subscriber.h"
#include "shared/match/match.h"

namespace woodlouse::server {

struct PendingAck {
  SessionId session = 0;
  match::PlayerId player = 0;
  std::uint32_t seq = 0;
  Time arrived{};
  bool late = false;
  bool clamped = false;
  std::uint64_t ticks_late = 0;  ///< how many steps after the one it asked for takes it
};

class PendingAcks {
 public:
  void add(std::uint64_t tick, const PendingAck& ack) { pending_[tick].push_back(ack); }

  /// Those whose step is `tick`.
  std::vector<PendingAck> take(std::uint64_t tick) {
    auto node = pending_.extract(tick);
    return node.empty() ? std::vector<PendingAck>{} : std::move(node.mapped());
  }

 private:
  std::map<std::uint64_t, std::vector<PendingAck>> pending_;
};

}  // namespace woodlouse::server
