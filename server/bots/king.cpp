#include "server/bots/king.h"

#include <algorithm>
#include <array>

namespace woodlouse::server::bots {
namespace {

using core::Vec2;

constexpr double kNearer = 1.0;      // what counts as nearer [m]
constexpr double kPushLead = 0.3;    // how far ahead of a rival it aims [s]
constexpr double kPushRadius = 0.5;  // [m]
constexpr double kAside = 2.0;       // past the place's rim, where it waits [m]
constexpr double kRunUp = 4.0;       // how far from a rival it goes back [m]
// How long it puts up with a rival, goes back, and charges; the first and the last as much again by chance
// [s].
constexpr double kBears = 0.8, kGoesBack = 1.0, kCharges = 1.2;

struct Rivals {
  std::size_t count = 0;                    ///< on the place, where they will be
  const state::Louse* outermost = nullptr;  ///< of them; null: nobody is
};

Rivals rivals_of(const Scene& scene, const Effort& effort, double lag) {
  const Place& place = scene.seen.place;
  Rivals rivals;
  double most = 0.0;
  for (const state::Louse& louse : scene.seen.lice) {
    if (louse.id == scene.seen.lice[scene.own].id || louse.phase == state::Phase::kFlying) continue;
    const Vec2 at = louse.position + lag * louse.velocity;
    const double out = length(at - effort.images().nearest(at, place.at));
    if (out > place.radius) continue;
    ++rivals.count;
    if (out < most) continue;
    most = out;
    rivals.outermost = &louse;
  }
  return rivals;
}

}  // namespace

void King::make_plan(const Scene& scene, std::size_t rivals) {
  const auto in = [&scene](double seconds) {
    return scene.tick + static_cast<std::uint64_t>(seconds / scene.tick_s);
  };
  const double luck = 1.0 + random().uniform();
  if (rivals == 0 && plan_ != Plan::kCharge) {
    plan_ = Plan::kStay;
    plan_until_ = in(kBears * luck);
  }
  if (scene.tick < plan_until_) return;
  switch (plan_) {
    case Plan::kStay:  // the more there are, the longer it leaves them to each other
      plan_ = Plan::kGoBack;
      plan_until_ = in(kGoesBack * static_cast<double>(std::max<std::size_t>(1, rivals)) * luck);
      break;
    case Plan::kGoBack:
      plan_ = Plan::kCharge;
      plan_until_ = in(kCharges * luck);
      break;
    case Plan::kCharge:
      plan_ = Plan::kStay;
      plan_until_ = in(kBears * luck);
      break;
  }
}

Player::Choice King::choose(const Scene& scene, Foresight& foresight) {
  const Place& place = scene.seen.place;
  if (!(place.radius > 0.0)) return {};
  const Effort& effort = foresight.effort();
  if (length(place.at - place_) > 0.01) patience_.begin(scene.tick);
  place_ = place.at;
  const state::Louse now = foresight.now(ask(scene, {}));
  const Vec2 middle = effort.images().nearest(now.position, place.at);
  const double out = length(now.position - middle);
  const double lag = static_cast<double>(scene.tick - scene.seen.tick) * scene.tick_s;
  const Rivals rivals = rivals_of(scene, effort, lag);
  const state::Louse* other = out < place.radius + kRunUp ? rivals.outermost : nullptr;
  make_plan(scene, other != nullptr ? rivals.count : 0);
  std::array<Goal, 2> goals = {Goal::stay(place.at, place.radius), Goal::stay(place.at, place.radius)};
  std::size_t count = 1;
  if (other != nullptr) {
    const Vec2 at =
        effort.images().nearest(now.position, other->position + (lag + kPushLead) * other->velocity);
    if (plan_ == Plan::kGoBack) {
      // Of one to the middle's side, from where he is driven out by the shortest way; several are left alone.
      const Vec2 away = direction(middle - at + 0.5 * (now.position - at));
      const Vec2 off = direction(now.position - middle + 0.01 * away);
      goals[0] = rivals.count == 1 ? Goal::stay(at + kRunUp * away, kPushRadius)
                                   : Goal::stay(middle + (place.radius + kAside) * off, kPushRadius);
    } else if (plan_ == Plan::kCharge || length(at - middle) > out) {
      goals[0] = Goal::near(at, kPushRadius);
      count = 2;
    }
  }
  const Foresight::Question question = ask(scene, std::span(goals).first(count));
  if (out > place.radius && plan_ == Plan::kStay &&
      patience_.is_out(scene.tick, scene.tick_s, out, kNearer, random()))
    return {foresight.swing(question)};
  return {foresight.best_push(question)};
}

}  // namespace woodlouse::server::bots
