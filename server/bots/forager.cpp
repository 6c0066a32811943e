#include "server/bots/forager.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace woodlouse::server::bots {
namespace {

using core::Vec2;

constexpr double kKeeps = 1.3;         // what the crumb that it is after is worth more than another
constexpr double kLeavesAlone = 10.0;  // for how long one that it does not come nearer to [s]
constexpr double kNearer = 1.0;        // what counts as nearer [m]
constexpr double kReach = 0.8;         // of the radius, what it aims for
constexpr double kRivals = 0.4;        // what a crumb is worth that another one is nearer to
constexpr double kLeastSlope = 0.05;   // as which a smaller one that is climbed counts

bool is_same(Vec2 a, Vec2 b) { return length(a - b) < 0.01; }

}  // namespace

double Forager::worth(const Effort& effort, const state::Louse& louse, const Crumb& crumb) {
  const state::Parameters& physics = effort.map().definition.physics;
  const Vec2 way = effort.images().nearest(louse.position, crumb.at) - louse.position;
  const double climb = effort.ground(crumb.at).z - effort.ground(louse.position).z;
  const double speed = std::max(0.0, core::dot(louse.velocity, direction(way)));
  const double run_up = physics.gravity > 0.0 ? speed * speed / (2.0 * physics.gravity) : 0.0;
  const double slope = std::max(kLeastSlope, effort.climbable());
  return crumb.value / (length(way) + 0.5 + 3.0 * std::max(0.0, climb / slope - run_up));
}

std::optional<Vec2> Forager::best(const Scene& scene, const Effort& effort, const state::Louse& louse,
                                  std::optional<Vec2> besides) {
  std::optional<Vec2> best;
  double most = 0.0;
  for (const Crumb& crumb : scene.seen.crumbs) {
    if (besides && is_same(*besides, crumb.at)) continue;
    if (left_alone_ && is_same(*left_alone_, crumb.at)) continue;
    double worth = Forager::worth(effort, louse, crumb);
    if (!besides && target_ && is_same(*target_, crumb.at)) worth *= kKeeps;
    if (skill_ == Skill::kEasy) worth *= 0.7 + 0.6 * random().uniform();
    if (skill_ == Skill::kHard) {
      const auto to = [&](Vec2 place) { return length(effort.images().nearest(place, crumb.at) - place); };
      const double own = to(louse.position);
      const bool is_late = std::any_of(
          scene.seen.lice.begin(), scene.seen.lice.end(),
          [&](const state::Louse& other) { return other.id != louse.id && to(other.position) < 0.6 * own; });
      if (is_late) worth *= kRivals;
    }
    if (!(worth > most)) continue;
    most = worth;
    best = crumb.at;
  }
  return best;
}

Player::Choice Forager::choose(const Scene& scene, Foresight& foresight) {
  const Effort& effort = foresight.effort();
  if (scene.tick >= left_alone_until_) left_alone_.reset();
  state::Louse now = foresight.now(ask(scene, {}));
  now.id = scene.seen.lice[scene.own].id;
  const std::optional<Vec2> target = best(scene, effort, now, std::nullopt);
  if (!target) return {};
  if (!target_ || !is_same(*target_, *target)) patience_.begin(scene.tick);
  target_ = target;
  std::array<Goal, 2> goals = {Goal::near(*target, kReach * radius_), {}};
  std::size_t count = 1;
  if (skill_ != Skill::kEasy) {
    state::Louse there = now;  // with the one after it in mind
    there.position = *target;
    there.velocity = {};
    if (const auto next = best(scene, effort, there, target))
      goals[count++] = Goal::near(*next, kReach * radius_);
  }
  const Foresight::Question question = ask(scene, std::span(goals).first(count));
  const double distance = length(effort.images().nearest(now.position, *target) - now.position);
  if (patience_.is_out(scene.tick, scene.tick_s, distance, kNearer, random())) {
    left_alone_ = target;
    left_alone_until_ = scene.tick + static_cast<std::uint64_t>(kLeavesAlone / scene.tick_s);
    return {foresight.swing(question)};
  }
  return {foresight.best_push(question)};
}

}  // namespace woodlouse::server::bots
