#include "server/bots/effort.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/rules/climb.h"

namespace woodlouse::server::bots {
namespace {

using core::Vec2;

constexpr double kBefore = 6.0;       // how far before a gate one turns who is behind it [m]
constexpr double kInner = 0.7;        // of a gate, what one aims at
constexpr double kSampleEvery = 2.0;  // of a way, at least [m]
constexpr int kMostSamples = 24;
constexpr double kSlowest = 0.5;     // [m/s]
constexpr double kSwingPower = 2.0;  // the speed at which a swing gains by its thrust [m/s]
constexpr double kSwing = 8.0;       // what it takes to begin with [s]
/// Of what can't be held against a pull aside: how much of it counts.
constexpr double kHeld = 0.5;
constexpr double kPassing = 3.0;  // from which speed on less of it [m/s]
/// Of a motion across the way: how long it is to be pushed against.
constexpr double kAcross = 0.7;

}  // namespace

Effort::Effort(const map::Map& map, double power) : map_(&map), images_(rules::images_of(*map_)) {
  const state::Parameters& physics = map_->definition.physics;
  climbable_ = rules::climbable_slope(physics);
  thrust_ = std::max(0.05, power * physics.thrust_max - physics.friction * physics.gravity);
}

terrain::SurfaceSample Effort::ground(Vec2 place) const { return rules::ground_at(*map_, images_, place); }

/// Straight from one place to another, from that speed ahead on.
Effort::Leg Effort::leg(Vec2 from, double speed_ahead, Vec2 to, bool flies) const {
  const state::Parameters& physics = map_->definition.physics;
  const double distance = length(to - from);
  if (distance < 1e-6) return {};
  const Vec2 ahead = (1.0 / distance) * (to - from);
  Leg leg;
  const auto sample_at = [&](double s) {
    const auto sample = ground(from + s * ahead);
    return std::pair(sample, sample.zx * ahead.x + sample.zy * ahead.y);
  };
  auto [here, slope] = sample_at(0.0);
  double energy = 0.5 * speed_ahead * speed_ahead * (1.0 + slope * slope);
  const int samples = std::clamp(static_cast<int>(distance / kSampleEvery), 3, kMostSamples);
  const double step = distance / samples;
  const double least = 0.5 * kSlowest * kSlowest;
  double lack_of_lift = flies ? 1e9 : 0.0;
  for (int k = 1; k <= samples; ++k) {
    const auto [there, rise] = sample_at(k * step);
    const double ds = std::hypot(step, there.z - here.z);
    const double speed = std::sqrt(2.0 * std::max(energy, least));
    // What pulls aside is to be held against, the longer it does.
    const double aside = std::min(1.0, kPassing * kPassing / (speed * speed)) *
                         std::abs(there.zy * ahead.x - there.zx * ahead.y) * physics.gravity /
                         (1.0 + there.zx * there.zx + there.zy * there.zy);
    const double thrust = std::sqrt(std::max(0.01 * thrust_ * thrust_, thrust_ * thrust_ - aside * aside));
    leg.lack += kHeld * std::max(0.0, aside - thrust_) * ds;
    double next = energy + (thrust - physics.drag * speed) * ds - physics.gravity * (there.z - here.z);
    if (next < least) {
      leg.lack += least - next;
      next = least;
    }
    leg.seconds += ds / (0.5 * (speed + std::sqrt(2.0 * next)));
    energy = next;
    here = there;
    if (!flies) continue;
    // Who bends down faster than he falls lifts off: v^2 z'' + g < 0 along the way.
    const double bend =
        there.zxx * ahead.x * ahead.x + 2.0 * there.zxy * ahead.x * ahead.y + there.zyy * ahead.y * ahead.y;
    if (bend < 0.0)
      lack_of_lift = std::min(
          lack_of_lift, std::max(0.0, 0.5 * physics.gravity / (0.0 - bend) * (1.0 + rise * rise) - energy));
  }
  if (flies && lack_of_lift < 1e9) leg.lack += lack_of_lift;
  leg.speed = std::sqrt(2.0 * energy);
  return leg;
}

double Effort::with_swings(const Leg& leg) const {
  return leg.lack <= 0.0 ? leg.seconds : leg.seconds + kSwing + leg.lack / (thrust_ * kSwingPower);
}

Effort::Leg Effort::way(Vec2 from, Vec2 velocity, Vec2 to, bool flies) const {
  const double distance = length(to - from);
  if (distance < 1e-6) return {0.0, 0.0, length(velocity)};
  const Vec2 ahead = (1.0 / distance) * (to - from);
  double along = core::dot(velocity, ahead);
  double before = kAcross * length(velocity - along * ahead) / thrust_;
  if (along < 0.0) {
    // Away from it: until it stands.
    const auto here = ground(from);
    const double rise = 0.0 - (here.zx * ahead.x + here.zy * ahead.y);
    const double braking = std::max(0.25 * thrust_, thrust_ + map_->definition.physics.gravity * rise);
    before -= along / braking;
    from += (0.0 - 0.5 * along * along / braking) * ahead;
    along = 0.0;
  }
  Leg whole = leg(from, along, to, flies);
  whole.seconds += before;
  return whole;
}

Vec2 Effort::aim(const state::Louse& louse, const Goal& goal) const {
  const Vec2 shift = images_.shift(louse.position, goal.at);
  if (goal.kind != GoalKind::kGate) return goal.at + shift;
  const Goal near = goal.moved(shift);
  const Vec2 along = direction(near.gate.b - near.gate.a);
  const double before = 0.0 - core::dot(louse.position - near.at, near.way());
  const double half = 0.5 * kInner * length(near.gate.b - near.gate.a);
  const double aside = core::dot(louse.position - near.at, along);
  if (before > 0.0) return near.at + std::clamp(aside, 0.0 - half, half) * along;
  // Behind it: round its nearer end, and back before it.
  const double width = length(near.gate.b - near.gate.a);
  const double beside = std::abs(aside) < 0.5 * width ? std::copysign(0.5 * width + 1.0, aside) : aside;
  return near.at - kBefore * near.way() + std::clamp(beside, 0.0 - width, width) * along;
}

double Effort::seconds_to(const state::Louse& louse, const Goal& goal) const {
  const Vec2 to = aim(louse, goal);
  const bool flies = goal.kind == GoalKind::kGate && goal.gate.in_air && louse.phase != state::Phase::kFlying;
  const Goal near = goal.moved(images_.shift(louse.position, goal.at));
  const double there = with_swings(way(louse.position, louse.velocity, to, flies));
  if (goal.kind != GoalKind::kGate || core::dot(louse.position - near.at, near.way()) < 0.0) return there;
  return there + with_swings(leg(to, 0.0, near.at, flies)) + 1.0;
}

}  // namespace woodlouse::server::bots
