#include "shared/match/step_error.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "shared/map/map_world.h"

namespace woodlouse::match {
namespace {

/// Of small differences too: 1e-170 m squared is no number any more, but no error that counts either.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

/// The difference of two places in [low, high), by whole periods.
double shorter(double difference, double period) {
  const double size = std::fabs(difference);
  return size > 0.5 * period ? period - size : size;
}

double rounding_of(const state::Louse& louse) {
  constexpr double kLastDigit = std::numeric_limits<double>::epsilon();
  return StepError::kRounding * kLastDigit *
         (length(louse.position.x, louse.position.y) + length(louse.velocity.x, louse.velocity.y));
}

}  // namespace

PartedTick::PartedTick(const map::Map& map, double tick, state::Mode mode, std::uint32_t parts)
    : world_(map::make_world(map, tick / parts, mode)), parts_(parts) {
  assert(tick > 0.0 && parts > 0);
}

std::span<const state::Louse> PartedTick::run(std::span<const state::Louse> lice) {
  held_.assign(lice.begin(), lice.end());
  for (state::Louse& louse : held_) {
    if (louse.thrust_ticks != 0) louse.thrust_ticks = state::kHeld;
  }
  world_.restore(held_);
  for (std::uint32_t part = 0; part < parts_; ++part) world_.step();
  return world_.lice();
}

double distance_over_map(core::Vec2 a, core::Vec2 b, const terrain::Rectangle& domain, state::Edges edges) {
  double x = std::fabs(a.x - b.x);
  double y = std::fabs(a.y - b.y);
  if (edges == state::Edges::kWrap) {
    x = shorter(x, domain.x_max - domain.x_min);
    y = shorter(y, domain.y_max - domain.y_min);
  }
  return length(x, y);
}

double distance_apart(const state::Louse& a, const state::Louse& b, const terrain::Rectangle& domain,
                      state::Edges edges) {
  const core::Vec2 v = a.velocity - b.velocity;
  return distance_over_map(a.position, b.position, domain, edges) + kAhead * length(v.x, v.y);
}

StepError::StepError(const map::Map& map, double tick, state::Mode mode)
    : tick_seconds_(tick),
      domain_(map.terrain->domain()),
      edges_(map::physics_of(map.definition, mode).edges),
      whole_(map, tick, mode, 1),
      parts_(map, tick, mode, kParts) {}

void StepError::observe(std::span<const state::Louse> lice, std::uint64_t tick) {
  stepped_ = whole_.run(lice);
  const std::span<const state::Louse> finer = parts_.run(lice);
  assert(stepped_.size() == lice.size() && finer.size() == lice.size());
  bounds_.clear();
  for (std::size_t i = 0; i < lice.size(); ++i) {
    const state::Louse& end = stepped_[i];
    assert(end.id == lice[i].id && finer[i].id == end.id);
    const bool rested = lice[i].phase == state::Phase::kResting && end.phase == state::Phase::kResting;
    const double bound =
        rested ? 0.0 : kSafety * distance_apart(end, finer[i], domain_, edges_) + rounding_of(end);
    bounds_.push_back(bound);
    ErrorFigure& figure = figures_[end.id];
    ++figure.ticks;
    figure.sum += bound;
    if (bound > figure.worst) {
      figure.worst = bound;
      figure.worst_tick = tick;
    }
  }
}

double StepError::of_play(const ErrorFigure& figure) const {
  return figure.ticks == 0 ? 0.0 : figure.sum / (static_cast<double>(figure.ticks) * tick_seconds_);
}

}  // namespace woodlouse::match
