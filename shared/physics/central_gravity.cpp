#include "shared/physics/central_gravity.h"

#include "shared/physics/sub_step_rules.h"

namespace woodlouse::physics {
namespace {

constexpr double kLowestRate = 15.0;  // [1/s]

/// Newton's method from above, which falls until it has the root to rounding: the same bits everywhere.
double cube_root(double value) {
  assert(value > 0.0 && value <= 1e12);
  double root = 1e4;
  for (;;) {
    const double next = (2.0 * root + value / (root * root)) / 3.0;
    if (!(next < root)) return root;
    root = next;
  }
}

}  // namespace

double resolved_core_radius(double central_gravity, double tick_hz) {
  assert(central_gravity > 0.0 && tick_hz >= 1.0);
  const double swing = tick_hz * kMaxSubSteps * kOrbit;
  return cube_root(kCorePull * central_gravity / (swing * swing));
}

double resolving_rate(double central_gravity, double core_radius) {
  assert(central_gravity > 0.0 && core_radius > 0.0);
  const double pull = kCorePull * central_gravity / (core_radius * core_radius * core_radius);
  return core::square_root(pull) / (kMaxSubSteps * kOrbit);
}

double default_core_radius(double central_gravity) {
  return resolved_core_radius(central_gravity, kLowestRate);
}

}  // namespace woodlouse::physics
