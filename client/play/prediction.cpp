#include "client/play/prediction.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "shared/map/map_world.h"

namespace woodlouse::client {
Prediction::Prediction(const map::Map& map, std::uint32_t tick_hz, state::Mode mode)
    : ways_(map.terrain->domain(), map.definition.physics.edges),
      mode_(mode),
      world_(map::make_world(map, 1.0 / tick_hz, mode)) {}

void Prediction::sent(std::uint32_t seq, std::uint64_t tick, const ThrustOrder& order) {
  assert(pending_.empty() || (pending_.back().seq < seq && pending_.back().tick < tick));
  if (pending_.size() == kMaxPending) pending_.pop_front();
  pending_.push_back({seq, tick, order});
}

void Prediction::acknowledge(const protocol::Ack& ack) {
  // Pictures are rarer than acks: what it would have been is what is put right, and each tick is measured.
  // After a pause nothing would have been, and what was sent meanwhile still waits.
  if (ack.you && ack.you->tick > tick_ && ack.you->tick - tick_ <= kMaxAheadTicks) advance(ack.you->tick);
  while (!pending_.empty() && pending_.front().seq <= ack.seq) pending_.pop_front();
  if (!ack.you) return;
  const bool was_known = louse() != nullptr;
  const core::Vec2 believed = was_known ? louse()->position : ack.you->louse.position;
  const std::uint64_t target = std::max(tick_, ack.you->tick);
  if (id_) world_.erase(*id_);
  world_.insert(ack.you->louse);
  id_ = ack.you->louse.id;
  tick_ = ack.you->tick;
  while (!history_.empty() && history_.back().tick >= tick_) history_.pop_back();
  if (!history_.empty() && history_.back().tick + 1 != tick_) history_.clear();
  history_.push_back({tick_, louse()->position});
  // One that asked for a step already answered for came too late; a later step will take it: the next is the
  // best guess.
  for (const Pending& input : pending_) {
    if (input.tick < tick_) world_.set_thrust(*id_, input.order.thrust, input.order.ticks);
  }
  if (target - tick_ <= kMaxAheadTicks) advance(target);
  if (was_known && tick_ == target) correction_ += ways_.way(louse()->position, believed);
}

void Prediction::advance(std::uint64_t tick) {
  if (!id_) return;
  if (tick > tick_ &&
      tick - tick_ > kMaxAheadTicks) {  // a suspended client: what it believed is worth nothing
    forget();
    return;
  }
  while (tick_ < tick) step();
}

void Prediction::step() {
  for (const Pending& input : pending_) {
    if (input.tick == tick_) world_.set_thrust(*id_, input.order.thrust, input.order.ticks);
  }
  if (error_) error_->find(*louse(), tick_);
  world_.step();
  ++tick_;
  history_.push_back({tick_, louse()->position});
  if (history_.size() > kHistory) history_.pop_front();
}

void Prediction::forget() {
  if (id_) world_.erase(*id_);
  id_.reset();
  tick_ = 0;
  pending_.clear();
  history_.clear();
  correction_ = {};
  if (error_) error_->forget_waiting();
}

const state::Louse* Prediction::louse() const { return id_ ? world_.find(*id_) : nullptr; }

std::optional<core::Vec2> Prediction::position_at(std::uint64_t tick) const {
  if (history_.empty() || tick < history_.front().tick || tick > history_.back().tick) return std::nullopt;
  return history_[static_cast<std::size_t>(tick - history_.front().tick)].position;
}

core::Vec2 Prediction::take_correction() { return std::exchange(correction_, core::Vec2{}); }

}  // namespace woodlouse::client
