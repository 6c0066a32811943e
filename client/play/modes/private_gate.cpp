#include "client/play/modes/private_gate.h"

#include <chrono>
#include <cmath>

#include "client/drawing/formatted.h"

namespace woodlouse::client {
namespace {

using Seconds = std::chrono::duration<double>;

std::string seconds_text(double seconds) {
  const auto hundredths = static_cast<long>(seconds * 100.0);
  return formatted("%ld:%02ld.%02ld", hundredths / 6000, hundredths / 100 % 60, hundredths % 100);
}

}  // namespace

void PrivateGate::set(const LouseSample& louse, core::Vec2 heading, core::Time now) {
  forget();
  const core::Vec2 across = (0.5 * kWidth) * core::Vec2{heading.y, -heading.x};
  gate_ = map::Gate{louse.position - across, louse.position + across};
  began_ = now;
}

std::optional<double> PrivateGate::observe(const LouseSample& louse, const rules::Images& images,
                                           core::Time now) {
  if (!gate_) return std::nullopt;
  const std::optional<LouseSample> from = before_;
  const double seconds = Seconds(now - before_at_).count();
  const core::Time from_at = before_at_;
  before_ = louse;
  before_at_ = now;
  constexpr double kLongestStep = 0.5;  // [s]; whoever was not looked at for longer came by any way
  if (!from || !(seconds > 0.0 && seconds < kLongestStep)) return std::nullopt;
  const core::Vec2 to = images.nearest(from->position, louse.position);
  const core::Vec2 way = to - from->position;
  constexpr double kJump = 8.0;  // [m], a respawn
  if (core::dot(way, way) > kJump * kJump) return std::nullopt;
  const core::Vec2 shift = images.shift(from->position, gate_->a);
  const auto part = rules::crossing({gate_->a + shift, gate_->b + shift},
                                    {from->position, from->velocity, to, louse.velocity, seconds, false});
  if (!part) return std::nullopt;
  const core::Time at = from_at + std::chrono::duration_cast<core::Time::duration>(Seconds(*part * seconds));
  last_ = Seconds(at - began_).count();
  began_ = at;
  if (!best_ || *last_ < *best_) best_ = last_;
  return last_;
}

std::optional<GateMark> PrivateGate::mark() const {
  if (!gate_) return std::nullopt;
  return GateMark{gate_->a, gate_->b, "B", true, false};
}

GoalLine PrivateGate::line(core::Time now) const {
  if (!gate_) return {};
  GoalLine line{{"own gate  ", Tone::kUsual}, {seconds_text(Seconds(now - began_).count()), Tone::kStrong}};
  if (last_) line.push_back({"  last " + seconds_text(*last_), Tone::kUsual});
  if (best_) line.push_back({"  best " + seconds_text(*best_), Tone::kGoal});
  return line;
}

}  // namespace woodlouse::client
