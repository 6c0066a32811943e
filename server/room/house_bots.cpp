#include "server/room/house_bots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shared/protocol/messages.h"

namespace woodlouse::server {
namespace {

using core::Vec2;

constexpr double kFlat = 0.06;        // slope below which the ground counts as level [1]
constexpr double kSlow = 0.3;         // speed below which a louse counts as stopped [m/s]
constexpr std::uint32_t kKick = 20;   // decisions that a kick lasts
constexpr std::uint32_t kStuck = 15;  // decisions near rest after which any character kicks itself free

constexpr std::array<const char*, 4> kNames = {"Rolly", "Sherpa", "Saturn", "Nomad"};

double length(Vec2 v) { return std::hypot(v.x, v.y); }
Vec2 direction(Vec2 v) {
  const double size = length(v);
  return size > 1e-9 ? (1.0 / size) * v : Vec2{};
}

/// Pushes so that the velocity comes to `wanted`, the slope's pull made up for.
Vec2 drive(const View& view, Vec2 wanted) {
  const auto ground = view.terrain.sample(view.louse.position.x, view.louse.position.y);
  const Vec2 gradient{ground.zx, ground.zy};
  const double pull = view.parameters.gravity / (1.0 + core::dot(gradient, gradient));
  const Vec2 acceleration = 2.0 * (wanted - view.louse.velocity) + pull * gradient;
  return view.parameters.thrust_max > 0.0 ? (1.0 / view.parameters.thrust_max) * acceleration : Vec2{};
}

/// Cut to length 1 and to the wire's steps; towards zero, so that rounding never lengthens it.
state::Thrust as_thrust(Vec2 push) {
  const double size = length(push);
  if (size > 1.0) push = (1.0 / size) * push;
  return {state::ThrustKind::kMapVector, state::quanta_towards_zero(push)};
}

}  // namespace

HouseBot::HouseBot(std::uint32_t number, std::uint64_t seed)
    : character_(static_cast<Character>(number % kNames.size())),
      name_(kNames[number % kNames.size()]),
      random_(seed + 0x9E3779B97F4A7C15u * (number + 1)),
      radius_share_(0.35 + 0.35 * random_.uniform()),
      turn_(random_.next() % 2 == 0 ? 1.0 : -1.0) {
  if (number >= kNames.size()) name_ += ' ' + std::to_string(number / kNames.size() + 1);
}

state::Thrust HouseBot::decide(const View& view) {
  stuck_ = length(view.louse.velocity) < kSlow ? stuck_ + 1 : 0;
  if (kick_left_ > 0) {
    --kick_left_;
    return as_thrust(kick_);
  }
  if (stuck_ >= kStuck) return as_thrust(kick());
  switch (character_) {
    case Character::kRoller:
      return as_thrust(roll(view));
    case Character::kClimber:
      return as_thrust(climb(view));
    case Character::kOrbiter:
      return as_thrust(orbit(view));
    case Character::kWanderer:
      return as_thrust(wander(view));
  }
  return {};
}

Vec2 HouseBot::random_direction() {
  const double angle = 2.0 * std::numbers::pi * random_.uniform();
  return {std::cos(angle), std::sin(angle)};
}

Vec2 HouseBot::kick() {
  kick_ = random_direction();
  kick_left_ = kKick;
  stuck_ = 0;
  return kick_;
}

Vec2 HouseBot::roll(const View& view) {
  const auto ground = view.terrain.sample(view.louse.position.x, view.louse.position.y);
  const Vec2 gradient{ground.zx, ground.zy};
  if (length(view.louse.velocity) > kSlow) return {};
  return length(gradient) > kFlat ? -0.5 * direction(gradient) : kick();
}

Vec2 HouseBot::climb(const View& view) {
  const auto ground = view.terrain.sample(view.louse.position.x, view.louse.position.y);
  const Vec2 gradient{ground.zx, ground.zy};
  const double slope = length(gradient);
  const double speed = length(view.louse.velocity);
  // On a top or in a hollow, where up has no direction.
  if (slope < kFlat && speed < kSlow) return kick();
  const double pull =
      view.parameters.gravity * (slope + view.parameters.friction) / std::sqrt(1.0 + slope * slope);
  if (pull < view.parameters.thrust_max) return direction(gradient);
  // Too steep to climb from rest: swing like a child, with the motion, and back down where there is none.
  return speed > kSlow ? direction(view.louse.velocity) : -direction(gradient);
}

Vec2 HouseBot::orbit(const View& view) {
  const auto& domain = view.terrain.domain();
  const Vec2 middle{0.5 * (domain.x_min + domain.x_max), 0.5 * (domain.y_min + domain.y_max)};
  const double half = 0.5 * std::min(domain.x_max - domain.x_min, domain.y_max - domain.y_min);
  const Vec2 arm = view.louse.position - middle;
  const Vec2 out = length(arm) > 1e-6 ? direction(arm) : view.louse.heading;
  const double excess = length(arm) - radius_share_ * half;
  const double speed = std::clamp(0.25 * half, 1.0, 4.0);
  const Vec2 along{-turn_ * out.y, turn_ * out.x};
  return drive(view, speed * along - std::clamp(0.8 * excess, -speed, speed) * out);
}

Vec2 HouseBot::wander(const View& view) {
  const auto& domain = view.terrain.domain();
  const double width = domain.x_max - domain.x_min;
  const double height = domain.y_max - domain.y_min;
  const bool arrived = length(waypoint_ - view.louse.position) < 0.05 * std::min(width, height);
  if (patience_ == 0 || arrived) {
    waypoint_ = {domain.x_min + width * (0.1 + 0.8 * random_.uniform()),
                 domain.y_min + height * (0.1 + 0.8 * random_.uniform())};
    patience_ = 12 * kDecisionsPerSecond;
  }
  --patience_;
  const double speed = std::clamp(0.1 * std::min(width, height), 1.0, 4.0);
  return drive(view, speed * direction(waypoint_ - view.louse.position));
}

}  // namespace woodlouse::server
