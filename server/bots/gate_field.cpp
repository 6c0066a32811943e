#include "server/bots/gate_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace woodlouse::server::bots {
namespace {

using core::Vec2;

constexpr std::size_t kCourses = GroundMoves::kCourses;
constexpr std::size_t kSpeedCount = GroundMoves::kSpeeds.size();
constexpr double kTurn = 0.8;  // of the time in which the thrust gives that speed, for 45 degrees
constexpr int kMostSweeps = 200;
constexpr double kSettled = 0.02;  // a change that is none [s]
constexpr double kRunIn = 12.0;    // how far before a gate in the air one takes off, at most [m]

/// The speeds below and above, and how far it is between them, 0..1.
struct Between {
  std::size_t low = 0;
  double part = 0.0;
};
Between between(double speed) {
  std::size_t low = 0;
  while (low + 2 < kSpeedCount && GroundMoves::kSpeeds[low + 1] <= speed) ++low;
  const double from = GroundMoves::kSpeeds[low], to = GroundMoves::kSpeeds[low + 1];
  return {low, std::clamp((speed - from) / (to - from), 0.0, 1.0)};
}

/// Whether the way from p0 to p1 leads through it: 1 forwards, -1 backwards, 0 not.
int passes(const map::Gate& gate, Vec2 p0, Vec2 p1) {
  const double s0 = rules::side_of(gate, p0), s1 = rules::side_of(gate, p1);
  if ((s0 < 0.0) == (s1 < 0.0)) return 0;
  const Vec2 at = p0 + (s0 / (s0 - s1)) * (p1 - p0);
  const Vec2 along = gate.b - gate.a;
  const double part = core::dot(at - gate.a, along) / core::dot(along, along);
  if (part < 0.0 || part > 1.0) return 0;
  return s0 < 0.0 ? 1 : -1;
}

/// The least speed over the map at which one takes off before it [m/s].
double lift_of(const Effort& effort, const Goal& goal) {
  double least = 1e9;
  for (double before = 0.0; before <= kRunIn; before += 0.5) {
    const Vec2 way = goal.way();
    const auto ground = effort.ground(goal.at - before * way);
    const double bend =
        ground.zxx * way.x * way.x + 2.0 * ground.zxy * way.x * way.y + ground.zyy * way.y * way.y;
    if (bend < 0.0) least = std::min(least, effort.map().definition.physics.gravity / (0.0 - bend));
  }
  return std::sqrt(least);
}

}  // namespace

GateField::GateField(const GroundMoves& moves, const map::Gate& gate, const GateField* after)
    : moves_(moves),
      goal_(Goal::through(gate)),
      after_(after),
      values_(moves.squares() * kCourses * kSpeedCount, static_cast<float>(kFar)) {
  if (gate.in_air) lift_ = std::min(GroundMoves::kSpeeds.back() - 1.0, lift_of(moves.effort(), goal_));
  note_gate();
  for (int k = 0; k < kMostSweeps; ++k) {
    if (!sweep(k % 2 != 0)) break;
  }
}

void GateField::note_gate() {
  const rules::Images& images = moves_.effort().images();
  passes_.resize(moves_.squares() * kCourses);
  for (std::size_t square = 0; square < moves_.squares(); ++square) {
    const Vec2 from = moves_.middle(square);
    const Goal near = goal_.moved(images.shift(from, goal_.at));
    for (std::size_t course = 0; course < kCourses; ++course)
      passes_[square * kCourses + course] = passes(near.gate, from, from + moves_.step(course)) == 1;
  }
}

double GateField::value(std::size_t square, std::size_t course, double speed) const {
  const auto [low, part] = between(speed);
  return (1.0 - part) * at(square, course, low) + part * at(square, course, low + 1);
}

/// Of who has just driven through.
double GateField::through(std::size_t square, std::size_t course, double speed) const {
  if (speed < lift_) return kFar;
  return after_ != nullptr ? after_->value(square, course, speed) : 0.0;
}

/// Of the move that way, and all that follows.
double GateField::cost(std::size_t square, std::size_t course, std::size_t speed) const {
  const GroundMoves::Move& move = moves_.move(square, course, speed);
  if (move.to < 0) return kFar;
  const auto to = static_cast<std::size_t>(move.to);
  const auto v = static_cast<double>(move.speed);
  const double seconds = move.seconds;
  if (move.turns_back) return seconds + value(to, (course + kCourses / 2) % kCourses, v);
  if (passes_[square * kCourses + course] != 0 && v >= lift_) return seconds + through(to, course, v);
  return seconds + value(to, course, v);
}

double GateField::best(std::size_t square, std::size_t course, std::size_t speed) const {
  double least = cost(square, course, speed);
  if (speed == 0) {
    for (std::size_t other = 0; other < kCourses; ++other) least = std::min(least, cost(square, other, 0));
    return least;
  }
  const double v = GroundMoves::kSpeeds[speed];
  const double turn = kTurn * v / moves_.thrust();
  least = std::min(least, turn + cost(square, (course + 1) % kCourses, speed));
  least = std::min(least, turn + cost(square, (course + kCourses - 1) % kCourses, speed));
  const double slower = (v - GroundMoves::kSpeeds[speed - 1]) / moves_.thrust();
  return std::min(least, slower + at(square, course, speed - 1));
}

/// False: nothing changes any more.
bool GateField::sweep(bool backwards) {
  bool changes = false;
  for (std::size_t k = 0; k < moves_.squares(); ++k) {
    const std::size_t square = backwards ? moves_.squares() - 1 - k : k;
    for (std::size_t speed = 0; speed < kSpeedCount; ++speed) {
      for (std::size_t course = 0; course < kCourses; ++course) {
        float& now = at(square, course, speed);
        const double least = std::min(kFar, best(square, course, speed));
        if (!(least < now)) continue;
        changes = changes || least < now - kSettled;
        now = static_cast<float>(least);
      }
    }
  }
  return changes;
}

double GateField::seconds(Vec2 place, Vec2 velocity) const {
  const auto ground = moves_.effort().ground(place);
  const double climb = ground.zx * velocity.x + ground.zy * velocity.y;
  const double speed = std::sqrt(core::dot(velocity, velocity) + climb * climb);
  const double turned = std::atan2(velocity.y, velocity.x) * (kCourses / (2.0 * std::numbers::pi));
  const double from = std::floor(turned);
  const double part = turned - from;
  const auto first =
      static_cast<std::size_t>(static_cast<int>(from) + static_cast<int>(2 * kCourses)) % kCourses;
  const std::size_t second = (first + 1) % kCourses;
  const rules::Images& images = moves_.effort().images();
  const Goal near = goal_.moved(images.shift(place, goal_.at));
  double sum = 0.0, weights = 0.0;
  for (const auto& [square, weight] : moves_.around(place)) {
    if (weight <= 0.0) continue;
    // Who is before the gate is not where those behind it are, nor the other way round.
    const int side = passes(near.gate, place, images.nearest(place, moves_.middle(square)));
    if (side < 0) continue;
    const auto of = [&, square = square](std::size_t course) {
      return side > 0 && speed >= lift_ ? through(square, course, speed) : value(square, course, speed);
    };
    sum += weight * ((1.0 - part) * of(first) + part * of(second));
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : kFar;
}

Vec2 GateField::course(Vec2 place, Vec2 velocity) const {
  const std::size_t square = moves_.square_at(place);
  const double speed = length(velocity);
  const auto [low, part] = between(speed);
  const std::size_t level = part < 0.5 ? low : low + 1;
  const double turned = std::atan2(velocity.y, velocity.x) * (kCourses / (2.0 * std::numbers::pi));
  const auto own =
      static_cast<std::size_t>(static_cast<int>(std::lround(turned)) + static_cast<int>(2 * kCourses)) %
      kCourses;
  std::size_t best = own;
  double least = 1e9;
  for (std::size_t k = 0; k < kCourses; ++k) {
    const std::size_t course = (own + k) % kCourses;
    const std::size_t apart = std::min(k, kCourses - k);
    if (level != 0 && apart > 2) continue;
    const double cost =
        this->cost(square, course, level) + static_cast<double>(apart) * kTurn * speed / moves_.thrust();
    if (cost >= least) continue;
    least = cost;
    best = course;
  }
  return direction(moves_.step(best));
}

}  // namespace woodlouse::server::bots
