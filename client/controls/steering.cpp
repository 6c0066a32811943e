#include "client/controls/steering.h"

#include <algorithm>
#include <cassert>
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
  sides_ = {};
  sent_ = {};
  sent_until_ = kPast;
}

void Steering::set_pulse(std::chrono::milliseconds pulse) {
  assert(pulse >= kPulse);
  pulse_ = pulse;
}

void Steering::turn(Turn direction, core::Time now) {
  if (now < push_until_) push_until_ = now + pulse_;
  if (now < brake_until_) brake_until_ = now + pulse_;
  turns_ = (turns_ + (direction == Turn::kLeft ? 1 : kHeadings - 1)) % kHeadings;
}

core::Vec2 Steering::heading() const {
  const double angle = base_angle_ + turns_ * (2.0 * std::numbers::pi / kHeadings);
  return {std::cos(angle), std::sin(angle)};
}

void Steering::push(core::Time now) {
  push_until_ = now + pulse_;
  brake_until_ = kPast;
}

void Steering::brake(core::Time now) {
  brake_until_ = now + pulse_;
  push_until_ = kPast;
  for (Press& side : sides_) side.until = kPast;
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

void Steering::look_along(core::Vec2 up) {
  assert(std::abs(std::hypot(up.x, up.y) - 1.0) < 1e-6);
  up_ = up;
}

void Steering::push_to(Side side, core::Time now) {
  const auto index = static_cast<std::size_t>(side);
  sides_[index].until = now + pulse_;
  sides_[index ^ 1u] = {};  // who presses the other way means it
  brake_until_ = kPast;
  point_sideways(now);
}

void Steering::hold_to(Side side, core::Time now) {
  sides_[static_cast<std::size_t>(side)].held = true;
  point_sideways(now);
}

void Steering::release_to(Side side) { sides_[static_cast<std::size_t>(side)] = {}; }

core::Vec2 Steering::sideways(core::Time now) const {
  const core::Vec2 right{up_.y, -up_.x};
  const std::array<core::Vec2, 4> ways = {up_, -1.0 * up_, -1.0 * right, right};
  core::Vec2 sum;
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (sides_[i].acts(now)) sum += ways[i];
  return std::hypot(sum.x, sum.y) > 0.5 ? sum : core::Vec2{};
}

void Steering::point_sideways(core::Time now) {
  const core::Vec2 way = sideways(now);
  if (way != core::Vec2{}) point(way);
}

void Steering::release_all() {
  push_held_ = brake_held_ = false;
  for (Press& side : sides_) side.held = false;
}

bool Steering::pushing(core::Time now) const {
  return !braking(now) && (cruise_ || push_held_ || now < push_until_ || sideways(now) != core::Vec2{});
}

state::Thrust Steering::wanted(core::Time now) const {
  if (braking(now)) return {state::ThrustKind::kAlongHeading, {-1.0, 0.0}};
  if (pushing(now)) return {state::ThrustKind::kMapVector, wire_vector(heading())};
  return {};
}

core::Time Steering::wanted_until(core::Time now) const {
  if (braking(now)) return brake_held_ ? now + kPulse : brake_until_;
  if (cruise_ || push_held_) return now + kPulse;
  core::Time until = push_until_;
  for (const Press& side : sides_) until = std::max(until, side.held ? now + kPulse : side.until);
  return until;
}

double Steering::seconds_left(core::Time now) const {
  return pushing(now) || braking(now) ? seconds(wanted_until(now) - now) : 0.0;
}

std::optional<ThrustOrder> Steering::poll(core::Time now) {
  point_sideways(now);
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
