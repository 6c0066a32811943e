#include "client/play/modes/ghost_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "shared/map/map_world.h"

namespace woodlouse::client {
namespace {

bool is_finite(core::Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

bool is_thrust(state::ThrustKind kind, core::Vec2 value) {
  if (!is_finite(value) || core::dot(value, value) > 1.0) return false;
  return kind != state::ThrustKind::kNone || value == core::Vec2{};
}

}  // namespace

std::string why_no_drive(const map::Map& map, std::uint32_t tick_hz, const OwnDrive& drive) {
  constexpr double kFastest = 1e4;  // [m/s]
  const state::Louse& louse = drive.start;
  const double heading = core::dot(louse.heading, louse.heading);
  if (!is_finite(louse.position) || !map.terrain->domain().contains(louse.position.x, louse.position.y))
    return "it begins beside the map";
  if (!is_finite(louse.velocity) || core::dot(louse.velocity, louse.velocity) > kFastest * kFastest ||
      !is_finite(louse.heading) || std::abs(heading - 1.0) > 1e-6 || !std::isfinite(louse.distance) ||
      louse.distance < 0.0 || !is_thrust(louse.thrust_kind, louse.thrust))
    return "it begins in a state that no louse is in";
  if (louse.phase == state::Phase::kFlying || louse.flight_z != 0.0 || louse.flight_vz != 0.0)
    return "it begins in flight";
  if (drive.ticks == 0 || drive.ticks > state::kMostGhostSeconds * std::uint64_t{tick_hz})
    return "it takes no time, or too much";
  if (drive.inputs.size() > state::kMostGhostInputs) return "it has too many inputs";
  std::uint32_t last = 0;
  for (const state::GhostInput& input : drive.inputs) {
    if (input.at < last || input.ticks == 0 || !is_thrust(input.thrust.kind, input.thrust.value))
      return "one of its inputs is none";
    last = input.at;
  }
  return {};
}

GhostRun::GhostRun(const map::Map& map, std::uint32_t tick_hz, state::Mode mode, OwnDrive drive)
    : world_(map::make_world(map, 1.0 / tick_hz, mode)), drive_(std::move(drive)) {
  assert(map.detail == map::Detail::kExact);
  assert(why_no_drive(map, tick_hz, drive_).empty());
  drive_.start.id = kGhost;
  rewind();
}

void GhostRun::rewind() {
  if (world_.find(kGhost) != nullptr) world_.erase(kGhost);
  world_.insert(drive_.start);
  tick_ = 0;
  next_ = 0;
}

void GhostRun::step() {
  for (; next_ < drive_.inputs.size() && drive_.inputs[next_].at <= tick_; ++next_)
    if (drive_.inputs[next_].at == tick_)
      world_.set_thrust(kGhost, drive_.inputs[next_].thrust, drive_.inputs[next_].ticks);
  world_.step();
  ++tick_;
}

void GhostRun::run_to(std::uint32_t tick, std::uint32_t most_steps) {
  if (tick < tick_) rewind();
  for (std::uint32_t steps = 0; tick_ < tick && steps < most_steps; ++steps) step();
}

std::optional<LouseSample> GhostRun::at(double ticks) {
  const double since = std::max(0.0, ticks);
  if (since > drive_.ticks) return std::nullopt;
  const auto whole = static_cast<std::uint32_t>(since);
  run_to(whole, kMostSteps);
  const state::Louse* louse = world_.find(kGhost);
  if (louse == nullptr) return std::nullopt;  // it fell off an open edge
  LouseSample sample;
  const double part = tick_ == whole ? since - whole : 0.0;
  sample.position = louse->position + (part * world_.step_seconds()) * louse->velocity;
  sample.velocity = louse->velocity;
  sample.heading = louse->heading;
  sample.distance = louse->distance;
  return sample;
}

double GhostRun::distance_at(std::uint32_t ticks) {
  run_to(std::min(ticks, drive_.ticks), UINT32_MAX);
  const state::Louse* louse = world_.find(kGhost);
  return louse == nullptr ? 0.0 : louse->distance - drive_.start.distance;
}

}  // namespace woodlouse::client
