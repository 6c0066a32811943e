#include "client/play/steering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace woodlouse::client {
namespace {

constexpr core::Time kPast{};

double seconds(core::Time::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

core::Vec2 wire_vector(core::Vec2 unit) {
  const core::Vec2 cut = state::quanta_towards_zero(unit);
  return {cut.x + 0.0, cut.y + 0.0};  // no -0
}

void Steering::point(core::Vec2 heading) {
  base_angle_ = std::atan2(heading.y, heading.x);
  turns_ = 0;
}

void Steering::reset() {
  cruise_ = push_held_ = brake_held_ = false;
  push_until_ = brake_until_ = kPast;
  sent_ = {};
  sent_until_ = kPast;
}

void Steering::turn(Turn direction) {
  turns_ = (turns_ + (direction == Turn::kLeft ? 1 : kHeadings - 1)) % kHeadings;
}

core::Vec2 Steering::heading() const {
  const double angle = base_angle_ + turns_ * (2.0 * std::numbers::pi / kHeadings);
  return {std::cos(angle), std::sin(angle)};
}

void Steering::push(core::Time now) {
  push_until_ = now + kPulse;
  brake_until_ = kPast;
}

void Steering::brake(core::Time now) {
  brake_until_ = now + kPulse;
  push_until_ = kPast;
  cruise_ = false;
}

void Steering::hold_brake() {
  brake_held_ = true;
  cruise_ = false;
}

void Steering::release_push() {
  push_held_ = false;
  push_until_ = kPast;
}

void Steering::release_brake() {
  brake_held_ = false;
  brake_until_ = kPast;
}

void Steering::toggle_cruise() {
  cruise_ = !cruise_;
  push_until_ = brake_until_ = kPast;
}

void Steering::release_all() { push_held_ = brake_held_ = false; }

bool Steering::pushing(core::Time now) const {
  return !braking(now) && (cruise_ || push_held_ || now < push_until_);
}

state::Thrust Steering::wanted(core::Time now) const {
  if (braking(now)) return {state::ThrustKind::kAlongHeading, {-1.0, 0.0}};
  if (pushing(now)) return {state::ThrustKind::kMapVector, wire_vector(heading())};
  return {};
}

core::Time Steering::wanted_until(core::Time now) const {
  if (braking(now)) return brake_held_ ? now + kPulse : brake_until_;
  return cruise_ || push_held_ ? now + kPulse : push_until_;
}

double Steering::seconds_left(core::Time now) const {
  return pushing(now) || braking(now) ? seconds(wanted_until(now) - now) : 0.0;
}

std::optional<ThrustOrder> Steering::poll(core::Time now) {
  const state::Thrust want = wanted(now);
  if (want.kind == state::ThrustKind::kNone) {
    if (sent_until_ <= now) return std::nullopt;  // what was sent has ended, or is about to, by itself
    sent_until_ = kPast;
    sent_ = {};
    return ThrustOrder{{state::ThrustKind::kMapVector, {0.0, 0.0}}, 1};
  }
  const core::Time until = wanted_until(now);
  const bool same = want == sent_ && sent_until_ > now;
  if (same && (until <= sent_until_ || sent_until_ - now >= kRenewBefore)) return std::nullopt;
  sent_ = want;
  sent_until_ = until;
  const double ticks = std::ceil(seconds(until - now) * tick_hz_ - 1e-6);
  return ThrustOrder{want, static_cast<std::uint32_t>(std::max(1.0, ticks))};
}

}  // namespace woodlouse::client
