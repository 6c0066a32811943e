#include "client/play/pilot.h"

#include <algorithm>
#include <cmath>

namespace woodlouse::client {
namespace {

constexpr std::chrono::milliseconds kAskAgain{200};

/// The order the louse's own state describes: repeating it asks for an ack and changes nothing.
ThrustOrder order_in_force(const state::Louse* louse) {
  if (louse == nullptr || louse->thrust_ticks == 0) return {{state::ThrustKind::kMapVector, {}}, 1};
  return {{louse->thrust_kind, louse->thrust}, louse->thrust_ticks};
}

}  // namespace

void Lead::observe(const protocol::Ack& ack) {
  if (ack.late) {
    margin_ = std::min(kLargest, margin_ + 1.0);
    return;
  }
  const double early = static_cast<double>(ack.margin_us) * 1e-6 * tick_hz_;
  margin_ = std::clamp(margin_ - 0.1 * std::clamp(early - kTarget, -1.0, 1.0), kSmallest, kLargest);
}

Pilot::Pilot(const map::Map& map, std::uint32_t tick_hz, std::uint32_t id, state::Mode mode,
             std::uint32_t last_seq)
    : id_(id), steering_(tick_hz), lead_(tick_hz), seq_(last_seq), log_(tick_hz) {
  if (map.detail != map::Detail::kExact) return;
  ways_ = {map.terrain->domain(), map.definition.physics.edges};
  prediction_.emplace(map, tick_hz, mode);
}

protocol::Input Pilot::order(std::uint64_t tick, const ThrustOrder& wanted) {
  protocol::Input input;
  input.seq = ++seq_;
  input.thrust = wanted.thrust;
  if (wanted.ticks != state::kHeld) input.ticks = wanted.ticks;
  input.tick = tick;
  if (prediction_) prediction_->sent(input.seq, tick, wanted);
  log_.sent(input.seq, wanted);
  last_tick_ = tick;
  return input;
}

std::optional<protocol::Input> Pilot::update(core::Time now, ServerClock& clock, double rtt_seconds) {
  if (!clock.running()) return std::nullopt;
  ahead_ = std::max(ahead_, clock.tick(now) + lead_.ticks(rtt_seconds));
  auto next = static_cast<std::uint64_t>(std::max(0.0, ahead_));
  const state::Louse* louse = nullptr;
  if (prediction_) {
    prediction_->advance(next);
    next = std::max(next, prediction_->tick());
    louse = prediction_->louse();
    wants_state_ |= louse == nullptr;
  }
  fade(now);

  if (next <= last_tick_)
    return std::nullopt;  // this tick has its input; what is wanted now waits for the next
  if (const auto wanted = steering_.poll(now)) return order(next, *wanted);
  if (!wants_state_ || (asked_ && now - *asked_ < kAskAgain)) return std::nullopt;
  asked_ = now;
  return order(next, order_in_force(louse));
}

void Pilot::acknowledge(const protocol::Ack& ack) {
  lead_.observe(ack);
  log_.acknowledged(ack);
  if (prediction_) prediction_->acknowledge(ack);
  if (!ack.you) return;
  wants_state_ = false;
  asked_.reset();
  if (!heading_taken_) {
    const core::Vec2 way = look_at_ ? ways_.way(ack.you->louse.position, *look_at_) : core::Vec2{};
    const double length = std::hypot(way.x, way.y);
    steering_.point(length > 0.0 ? (1.0 / length) * way : ack.you->louse.heading);
    heading_taken_ = true;
  }
  if (!prediction_) return;
  correction_ += prediction_->take_correction();
  if (std::hypot(correction_.x, correction_.y) > kLargestFade) correction_ = {};
}

void Pilot::compare(std::uint64_t tick, const LouseSample& row) {
  const auto believed = prediction_ ? prediction_->position_at(tick) : std::nullopt;
  if (!believed || prediction_->pending() > 0) return;  // an ack is on its way anyway
  const core::Vec2 off = ways_.way(row.position, *believed);
  if (std::hypot(off.x, off.y) > kStray) wants_state_ = true;
}

void Pilot::begin_anew() {
  if (prediction_) prediction_->forget();
  ahead_ = 0.0;
  last_tick_ = 0;
  wants_state_ = true;
  asked_.reset();
  correction_ = {};
}

void Pilot::respawned() {
  if (prediction_) ended_ = log_.finish(prediction_->tick());
  if (prediction_) prediction_->forget();
  steering_.reset();
  heading_taken_ = false;
  wants_state_ = true;
  asked_.reset();
  correction_ = {};
}

void Pilot::fade(core::Time now) {
  const double seconds = std::chrono::duration<double>(now - last_update_).count();
  last_update_ = now;
  correction_ = std::exp(-std::clamp(seconds, 0.0, 1.0) / kFadeSeconds) * correction_;
}

std::optional<LouseSample> Pilot::sample() const {
  const state::Louse* louse = prediction_ ? prediction_->louse() : nullptr;
  if (louse == nullptr) return std::nullopt;
  const double part = std::clamp(ahead_ - static_cast<double>(prediction_->tick()), 0.0, 1.0);
  LouseSample result;
  result.position =
      ways_.place(louse->position + (part * prediction_->step_seconds()) * louse->velocity + correction_);
  result.velocity = louse->velocity;
  result.heading = louse->heading;
  result.distance = louse->distance;
  if (louse->phase == state::Phase::kFlying)
    result.flight_z = louse->flight_z + part * prediction_->step_seconds() * louse->flight_vz;
  return result;
}

}  // namespace woodlouse::client
