// Inputs that were filed and whose step has not run: who is to be told, and what.
// Pure. The room's strand owns it; bounded by the match's InputQueue::kMaxPending per player.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "server/room/subscriber.h"
#include "server/timing/clock.h"
#include "shared/match/match.h"

namespace woodlouse::server {

struct PendingAck {
  SessionId session = 0;
  match::PlayerId player = 0;
  std::uint32_t seq = 0;    ///< as its player counts
  std::uint32_t filed = 0;  ///< as the match does
  Time arrived{};
  bool late = false;
  bool clamped = false;
  std::uint64_t ticks_late = 0;  ///< how many steps after the one it asked for takes it
};

class PendingAcks {
 public:
  void add(std::uint64_t tick, const PendingAck& ack) {
    auto at = pending_.lower_bound(tick);
    if (at == pending_.end() || at->first != tick) at = pending_.insert(at, empty_list(tick));
    at->second.push_back(ack);
  }

  /// The one of that tick and player that was filed under that number; null: there is none.
  PendingAck* find(std::uint64_t tick, match::PlayerId player, std::uint32_t filed) {
    const auto at = pending_.find(tick);
    if (at == pending_.end()) return nullptr;
    // From the end: it is asked for by who comes next.
    const auto found = std::find_if(at->second.rbegin(), at->second.rend(), [&](const PendingAck& ack) {
      return ack.player == player && ack.filed == filed;
    });
    return found == at->second.rend() ? nullptr : &*found;
  }

  /// Moves those whose step is `tick` to `out` (cleared first).
  void take(std::uint64_t tick, std::vector<PendingAck>& out) {
    out.clear();
    auto node = pending_.extract(tick);
    if (node.empty()) return;
    std::swap(out, node.mapped());
    if (spare_.size() < kMostSpare) spare_.push_back(std::move(node));
  }

 private:
  static constexpr std::size_t kMostSpare = 16;
  using Pending = std::map<std::uint64_t, std::vector<PendingAck>>;

  Pending::node_type empty_list(std::uint64_t tick) {
    if (spare_.empty()) {
      Pending fresh;
      fresh.emplace(tick, std::vector<PendingAck>());
      return fresh.extract(tick);
    }
    auto node = std::move(spare_.back());
    spare_.pop_back();
    node.key() = tick;
    return node;
  }

  Pending pending_;
  std::vector<Pending::node_type> spare_;  ///< taken, for those to come
};

}  // namespace woodlouse::server
