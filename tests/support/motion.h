// Runs one louse on any surface through the real stepper.
#pragma once

#include "shared/physics/stepper.h"
#include "tests/support/surfaces.h"

namespace woodlouse::tests {

struct Run {
  state::Louse louse;
  physics::StepCounters counters;
};

/// One tick, compiled once for a surface and its forces, however many watch.
template <typename S, typename F>
[[gnu::noinline]] void advance(const physics::Stepper<S, F>& stepper, state::Louse& louse,
                               physics::StepCounters& counters) {
  state::StepEvents happened = 0;
  stepper.advance(louse, counters, happened);
}

/// A louse moved `ticks` ticks of 1/rate seconds without walls, unless `walls` says where they stand. After
/// each tick `watch(louse)` is called; it returns false to stop.
template <typename F, terrain::Surface S, typename Watch>
Run run(const S& surface, const state::Parameters& parameters, state::Louse louse, double rate, long ticks,
        const terrain::Rectangle& walls, const Watch& watch) {
  Run result;
  const physics::Stepper<S, F> stepper(surface, parameters, walls, 1.0 / rate);
  for (long i = 0; i < ticks && louse.phase != state::Phase::kResting; ++i) {
    advance(stepper, louse, result.counters);
    if (!watch(louse)) break;
  }
  result.louse = louse;
  return result;
}

template <typename F, terrain::Surface S>
Run run(const S& surface, const state::Parameters& parameters, const state::Louse& louse, double rate,
        long ticks) {
  return run<F>(surface, parameters, louse, rate, ticks, kNowhere, [](const state::Louse&) { return true; });
}

inline state::Louse moving(core::Vec2 position, core::Vec2 velocity, state::LouseId id = 1) {
  state::Louse louse;
  louse.id = id;
  louse.position = position;
  louse.velocity = velocity;
  return louse;
}

/// Kinetic plus potential energy per mass [J/kg].
template <terrain::Surface S>
double energy(const S& surface, const state::Louse& louse, double gravity) {
  const terrain::SurfaceSample s = surface.sample(louse.position.x, louse.position.y);
  return 0.5 * physics::squared_length_in_space(s, louse.velocity) + gravity * s.z;
}

}  // namespace woodlouse::tests
