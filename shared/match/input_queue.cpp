#include "shared/match/input_queue.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace woodlouse::match {

void InputQueue::remove_player(state::LouseId player) {
  for (const std::uint64_t tick : ticks_waited_for(player))
    waiting_.erase(waiting_.lower_bound({tick, player, 0}), waiting_.lower_bound({tick, player + 1, 0}));
  players_.erase(player);
}

std::set<std::uint64_t> InputQueue::ticks_waited_for(state::LouseId player) const {
  std::set<std::uint64_t> ticks;
  const auto found = players_.find(player);
  if (found == players_.end()) return ticks;
  std::size_t left = found->second.pending;
  for (auto at = waiting_.begin(); left > 0 && at != waiting_.end();) {
    const std::uint64_t tick = at->first.tick;
    at = waiting_.lower_bound({tick, player, 0});
    for (; at != waiting_.end() && at->first.tick == tick && at->first.player == player; ++at, --left)
      ticks.insert(tick);
    if (at != waiting_.end() && at->first.tick == tick) at = waiting_.lower_bound({tick + 1, 0, 0});
  }
  assert(left == 0);
  return ticks;
}

/// Whether the last of what waits for that tick is an end already, as of somebody who broke off before.
bool InputQueue::ends_thrust(state::LouseId player, std::uint64_t tick) const {
  auto after = waiting_.lower_bound({tick, player + 1, 0});
  if (after == waiting_.begin()) return false;
  const AppliedInput& last = std::prev(after)->second;
  return last.tick == tick && last.player == player && last.thrust == core::Vec2{} &&
         last.ticks == state::kHeld;
}

std::uint32_t InputQueue::end_thrusts(state::LouseId player, std::uint32_t seq,
                                      std::set<std::uint64_t> ticks) {
  ticks.merge(ticks_waited_for(player));
  for (const std::uint64_t tick : ticks) {
    if (ends_thrust(player, tick)) continue;
    file_applied({player, seq++, {}, state::ThrustKind::kAlongHeading, state::kHeld, tick});
  }
  return seq;
}

Filed InputQueue::file(const Input& input, std::uint64_t next_tick, std::size_t per_tick) {
  assert(per_tick >= 1);
  const auto found = players_.find(input.player);
  if (found == players_.end()) return {Filed::Outcome::kNoLouse, next_tick, false};
  Player& player = found->second;
  const bool late = input.wanted_tick != 0 && input.wanted_tick < next_tick;
  const std::uint64_t tick = std::max(input.wanted_tick, next_tick);
  if (player.any && input.seq <= player.last_seq) return {Filed::Outcome::kStaleSeq, tick, late};
  if (tick - next_tick > horizon_) return {Filed::Outcome::kTooFar, tick, late};
  Filed filed{Filed::Outcome::kFiled, tick, late};
  std::size_t of_tick = 0;
  auto last = waiting_.lower_bound({tick, input.player, 0});
  for (auto at = last; at != waiting_.end() && at->first.tick == tick && at->first.player == input.player;
       ++at, ++of_tick)
    last = at;
  if (player.gap != next_tick) {
    player.gap = next_tick;
    player.first_of_gap = input.seq;
  }
  if (of_tick >= per_tick) {
    if (last->first.seq < player.first_of_gap) return {Filed::Outcome::kQueueFull, tick, late};
    filed.replaced = last->first.seq;
    waiting_.erase(last);
  } else if (player.pending >= kMaxPending) {
    return {Filed::Outcome::kQueueFull, tick, late};
  } else {
    ++player.pending;
  }
  player.any = true;
  player.last_seq = input.seq;
  wait({input.player, input.seq, input.thrust.value, input.thrust.kind, input.ticks, tick});
  return filed;
}

bool InputQueue::file_applied(const AppliedInput& input) {
  const auto found = players_.find(input.player);
  if (found == players_.end()) return false;
  Player& player = found->second;
  player.last_seq = player.any ? std::max(player.last_seq, input.seq) : input.seq;
  player.any = true;
  if (wait(input)) ++player.pending;
  return true;
}

bool InputQueue::wait(const AppliedInput& input) {
  const Key key{input.tick, input.player, input.seq};
  if (spare_.empty()) return waiting_.emplace(key, input).second;
  auto node = std::move(spare_.back());
  spare_.pop_back();
  node.key() = key;
  node.mapped() = input;
  waiting_.insert(waiting_.end(), std::move(node));  // a recording's come in their order
  const bool is_there_already = !node.empty();
  if (is_there_already) spare_.push_back(std::move(node));
  return !is_there_already;
}

void InputQueue::take(std::uint64_t tick, std::vector<AppliedInput>& out) {
  out.clear();
  while (!waiting_.empty() && waiting_.begin()->first.tick <= tick) {
    auto node = waiting_.extract(waiting_.begin());
    out.push_back(node.mapped());
    --players_.at(node.key().player).pending;
    if (spare_.size() < kMostSpare) spare_.push_back(std::move(node));
  }
}

std::vector<PlayerSeq> InputQueue::players() const {
  std::vector<PlayerSeq> result;
  result.reserve(players_.size());
  for (const auto& [id, player] : players_) {
    result.push_back({id, player.any ? std::optional(player.last_seq) : std::nullopt});
  }
  return result;
}

std::vector<AppliedInput> InputQueue::waiting() const {
  std::vector<AppliedInput> result;
  result.reserve(waiting_.size());
  for (const auto& entry : waiting_) result.push_back(entry.second);
  return result;
}

void InputQueue::restore(std::span<const PlayerSeq> players, std::span<const AppliedInput> waiting) {
  players_.clear();
  waiting_.clear();
  for (const PlayerSeq& entry : players) {
    players_[entry.player] = Player{entry.last_seq.value_or(0), entry.last_seq.has_value()};
  }
  for (const AppliedInput& input : waiting) {
    wait(input);
    ++players_.at(input.player).pending;
  }
}

}  // namespace woodlouse::match
