#include "server/bots/foresight.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "server/bots/gate_field.h"
#include "shared/map/map_world.h"

namespace woodlouse::server::bots {
namespace {

using core::Vec2;

constexpr int kRethinkSteps = 4;  // of a try: how long it pushes one way
constexpr int kShortSteps = 10, kLongSteps = 24;
constexpr double kAcrossGain = 1.5;      // [1/s], by which a motion across the way is pushed against
constexpr double kSlow = 0.4;            // [m/s]
constexpr double kWall = 0.4;            // what a bounce costs beside its speed [s]
constexpr double kWallNearPlace = 20.0;  // and where one may fall over the edge

Vec2 cut(Vec2 push, double most) {
  const double size = length(push);
  return size > most ? (most / size) * push : push;
}

}  // namespace

Foresight::Foresight(const map::Map& map, const Ability& ability)
    : ability_(ability), effort_(map, ability.power), world_(map::make_world(map, kStep)) {}

bool Foresight::passes(const state::Louse& before, const state::Louse& after, const Goal& goal) const {
  const rules::Images& images = effort_.images();
  const Vec2 p0 = before.position;
  const Vec2 p1 = images.nearest(p0, after.position);
  const Goal near = goal.moved(images.shift(p0, goal.at));
  if (goal.kind == GoalKind::kPlace) return false;
  if (goal.kind == GoalKind::kPoint) {
    const Vec2 d = p1 - p0;
    const double dd = core::dot(d, d);
    const double f = dd > 0.0 ? std::clamp(core::dot(near.at - p0, d) / dd, 0.0, 1.0) : 0.0;
    return length(p0 + f * d - near.at) <= goal.radius;
  }
  const bool flies = before.phase == state::Phase::kFlying || after.phase == state::Phase::kFlying;
  if (goal.gate.in_air && !flies) return false;
  return rules::crossing(near.gate, {p0, before.velocity, p1, after.velocity, kStep, false}).has_value();
}

/// From what was seen to now; the louse's own pushes are known to it.
void Foresight::catch_up(const Question& question, std::size_t& passed) {
  now_ = *question.louse;
  now_.id = 1;
  passed = 0;
  const int steps = static_cast<int>(std::lround((question.now - question.seen) / kStep));
  if (steps <= 0) return;
  world_.restore(std::span(&now_, 1));
  auto push = question.pushes.begin();
  for (int k = 0; k < steps; ++k) {
    const double at = question.seen + (k + 0.5) * kStep;
    while (push != question.pushes.end() && push->since <= at) {
      world_.set_thrust(1, push->thrust, state::kHeld);
      ++push;
    }
    world_.step();
    const state::Louse& after = *world_.find(1);
    while (passed < question.goals.size() && passes(now_, after, question.goals[passed])) ++passed;
    now_ = after;
  }
}

const state::Louse& Foresight::now(const Question& question) {
  std::size_t passed = 0;
  catch_up(question, passed);
  return now_;
}

Vec2 Foresight::swing(const Question& question) {
  return cut(with_motion(now(question), question.goals.front()), ability_.power);
}

/// What leads aside is pushed against first, the rest goes ahead.
Vec2 Foresight::along(const state::Louse& louse, Vec2 ahead) const {
  const state::Parameters& physics = effort_.map().definition.physics;
  const auto ground = effort_.ground(louse.position);
  const Vec2 gradient{ground.zx, ground.zy};
  const Vec2 pull = (physics.gravity / (1.0 + core::dot(gradient, gradient))) * gradient;
  const double thrust = std::max(1e-9, ability_.power * physics.thrust_max);
  const auto across = [ahead](Vec2 v) { return v - core::dot(v, ahead) * ahead; };
  Vec2 push = (1.0 / thrust) * (across(pull) - kAcrossGain * across(louse.velocity));
  const double size = length(push);
  if (size > 0.9) push = (0.9 / size) * push;
  return push + std::sqrt(1.0 - core::dot(push, push)) * ahead;
}

/// Straight there; to a place as fast as it can still stop.
Vec2 Foresight::towards(const state::Louse& louse, const Goal& goal) const {
  const Vec2 way = effort_.aim(louse, goal) - louse.position;
  if (goal.kind != GoalKind::kPlace) return along(louse, direction(way));
  const state::Parameters& physics = effort_.map().definition.physics;
  const auto ground = effort_.ground(louse.position);
  const Vec2 gradient{ground.zx, ground.zy};
  const Vec2 pull = (physics.gravity / (1.0 + core::dot(gradient, gradient))) * gradient;
  const double thrust = std::max(1e-9, ability_.power * physics.thrust_max);
  const double speed = std::sqrt(0.8 * thrust * length(way));
  return (ability_.power / thrust) * (2.0 * (speed * direction(way) - louse.velocity) + pull);
}

Vec2 Foresight::push(Then then, const state::Louse& louse, const Goal& goal) const {
  if (then == Then::kSwing) return with_motion(louse, goal);
  if (then == Then::kFollow && goal.field != nullptr)
    return along(louse, goal.field->course(louse.position, louse.velocity));
  return towards(louse, goal);
}

/// As one swings: with the motion, downhill where there is none.
Vec2 Foresight::with_motion(const state::Louse& louse, const Goal& goal) const {
  if (length(louse.velocity) > kSlow) return direction(louse.velocity);
  const auto ground = effort_.ground(louse.position);
  const Vec2 down = direction({0.0 - ground.zx, 0.0 - ground.zy});
  return core::dot(down, down) > 0.0 ? down : direction(effort_.aim(louse, goal) - louse.position);
}

void Foresight::make_tries(const Goal& goal) {
  tries_.clear();
  tries_.push_back({});
  const Vec2 swing = with_motion(now_, goal);
  tries_.push_back({swing, kRethinkSteps, Then::kSwing});
  tries_.push_back({swing, kLongSteps});
  tries_.push_back({-1.0 * direction(now_.velocity), kShortSteps});
  tries_.push_back({{}, kShortSteps});
  const auto push_any = [this, &goal](Vec2 push, int steps) {
    tries_.push_back({push, steps, Then::kStraight});
    if (goal.field != nullptr) tries_.push_back({push, steps, Then::kFollow});
  };
  if (goal.field != nullptr) tries_.push_back({{}, 0, Then::kFollow});
  const Vec2 ahead = direction(effort_.aim(now_, goal) - now_.position);
  const auto directions = static_cast<double>(ability_.directions);
  for (std::size_t k = 0; k < ability_.directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / directions;
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec2 push{c * ahead.x - s * ahead.y, s * ahead.x + c * ahead.y};
    push_any(push, kShortSteps);
    if (k % 2 == 0) tries_.push_back({push, kLongSteps});
  }
}

void Foresight::run(std::span<const Goal> goals, std::size_t passed, int steps) {
  lice_.assign(tries_.size(), now_);
  for (std::size_t k = 0; k < tries_.size(); ++k) {
    lice_[k].id = static_cast<state::LouseId>(k + 1);
    tries_[k].passed = passed;
  }
  world_.restore(lice_);
  for (int step = 0; step < steps; ++step) {
    if (step % 2 == 0) {
      for (std::size_t k = 0; k < tries_.size(); ++k) {
        const Try& one = tries_[k];
        const bool is_first = step < one.first_steps;
        if (is_first ? step != 0 : (step - one.first_steps) % kRethinkSteps != 0) continue;
        const Goal& goal = goals[std::min(one.passed, goals.size() - 1)];
        const Vec2 push = is_first ? one.first : this->push(one.then, lice_[k], goal);
        world_.set_thrust(
            lice_[k].id,
            {state::ThrustKind::kMapVector, state::quanta_towards_zero(cut(push, ability_.power))},
            state::kHeld);
      }
    }
    world_.step();
    const auto after = world_.lice();
    const auto met = world_.events();
    assert(after.size() == tries_.size());
    for (std::size_t k = 0; k < tries_.size(); ++k) {
      Try& one = tries_[k];
      while (one.passed < goals.size() && passes(lice_[k], after[k], goals[one.passed])) ++one.passed;
      const Goal& goal = goals[std::min(one.passed, goals.size() - 1)];
      const bool stays = goal.kind == GoalKind::kPlace;
      if ((met[k] & state::kMetWall) != 0) one.cost += stays ? kWallNearPlace : kWall;
      if (stays) {
        const Vec2 to = effort_.images().nearest(after[k].position, goal.at) - after[k].position;
        one.cost += kStep * std::max(0.0, length(to) - 0.5 * goal.radius);
      }
      lice_[k] = after[k];
    }
  }
}

double Foresight::cost(const Try& one, const state::Louse& end, std::span<const Goal> goals) const {
  double cost = one.cost;
  for (std::size_t k = 0; k < one.passed; ++k) cost -= goals[k].credit;
  if (one.passed >= goals.size()) return cost;
  const Goal& goal = goals[one.passed];
  if (goal.kind == GoalKind::kPlace) return cost + 0.3 * length(end.velocity);
  if (goal.field != nullptr) return cost + goal.field->seconds(end.position, end.velocity);
  return cost + effort_.seconds_to(end, goal);
}

Vec2 Foresight::best_push(const Question& question) {
  assert(question.louse != nullptr && !question.goals.empty());
  std::size_t passed = 0;
  catch_up(question, passed);
  const Goal& goal = question.goals[std::min(passed, question.goals.size() - 1)];
  make_tries(goal);
  run(question.goals, passed, static_cast<int>(ability_.horizon_s / kStep));
  const Try* best = nullptr;
  double least = 0.0;
  for (std::size_t k = 0; k < tries_.size(); ++k) {
    const double cost = this->cost(tries_[k], lice_[k], question.goals);
    if (best != nullptr && !(cost < least)) continue;
    best = &tries_[k];
    least = cost;
  }
  if (best->first_steps > 0) return cut(best->first, ability_.power);
  return cut(push(best->then, now_, goal), ability_.power);
}

}  // namespace woodlouse::server::bots
