#include "server/bots/player.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace woodlouse::server::bots {
namespace {

/// Turned, weakened, and cut to length 1 and to the wire's steps; towards zero: rounding never lengthens it.
state::Thrust as_thrust(core::Vec2 push, double angle, double most) {
  const double c = std::cos(angle), s = std::sin(angle);
  push = {c * push.x - s * push.y, s * push.x + c * push.y};
  const double size = length(push);
  if (size > most) push = (most / size) * push;
  return {state::ThrustKind::kMapVector, state::quanta_towards_zero(push)};
}

}  // namespace

Order Player::decide(const Scene& scene, Foresight& foresight) {
  const double seen = static_cast<double>(scene.seen.tick) * scene.tick_s;
  const auto later =
      std::find_if(pushes_.begin(), pushes_.end(), [seen](const Push& push) { return push.since > seen; });
  if (later != pushes_.begin()) pushes_.erase(pushes_.begin(), std::prev(later));
  const Choice choice = choose(scene, foresight);
  const double angle = ability_.aim_error * (2.0 * random_.uniform() - 1.0);
  Order order;
  order.respawns = choice.respawns;
  order.thrust = as_thrust(choice.respawns ? core::Vec2{} : choice.push, angle, ability_.power);
  pushes_.push_back({static_cast<double>(scene.tick) * scene.tick_s, order.thrust});
  return order;
}

Foresight::Question Player::ask(const Scene& scene, std::span<const Goal> goals) const {
  return {&scene.seen.lice[scene.own], static_cast<double>(scene.seen.tick) * scene.tick_s,
          static_cast<double>(scene.tick) * scene.tick_s, pushes_, goals};
}

}  // namespace woodlouse::server::bots
