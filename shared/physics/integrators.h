// The integrators that a map can ask for, one struct each; `Precise` is in precise.h. A step leads from a
// start (position, velocity, a1 = its acceleration, its surface sample) over h. `field` is the motion's right
// side:
//     field.sample(x)             the surface
//     field.accelerate(s, v)      the acceleration there
//     field.kick(s, v, k)         v after the implicit half kick v' = v + k a(s, v')
//     field.turns()               whether a thrust acts along a heading that turns (heading.h); then
//     field.heading()             that of the start, and both of the above take the heading as well
// A step says how much of h it used: all, or up to where it chose to stop; its way; where the heading has
// turned to.
//
// kSamples: how often a step asks for the surface and the acceleration there at most.
//
// kSubSteps: whether the sub-step rules and the friction stop apply (stepper.h); the document's Euler methods
// (document/euler.h) run bare. kKeepsEnergy: whether the ends of its steps are projected where nothing but
// gravity acts (energy_projection.h); the others show what they do by themselves. Orders are for smooth
// surfaces; a C2 spline caps them at about 2 where a step crosses a knot line, which `Precise` cures.
#pragma once

#include "shared/physics/nystrom.h"

namespace woodlouse::physics {

/// The result of a method that has no stages for the heading, nor a speed in the middle: what the start tells
/// of both. Order 1 in them.
template <typename Start, typename Field>
StepResult plain_result(const Start& start, const Field& field, const Motion& end, double h) {
  StepResult result{end, h, h * std::sqrt(start.speed2), {}};
  if (!field.turns()) return result;
  const core::Vec2 h1 = field.heading();
  const core::Vec2 mean = 0.5 * (start.at.velocity + end.velocity);
  const core::Vec2 middle = h1 + (0.5 * h) * heading_rate(h1, mean);
  result.heading = unit(h1 + h * heading_rate(middle, mean));
  return result;
}

/// Explicit half kick, drift, implicit half kick; one surface call a step. Order 2, time-reversible without
/// dissipation, so that the energy error stays bounded.
struct VerletQ {
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = false;
  static constexpr int kSamples = 2;
  template <typename Start, typename Field>
  StepResult step(const Start& start, const Field& field, double h) const {
    const double k = 0.5 * h;
    const core::Vec2 half = start.at.velocity + k * start.acceleration;
    const core::Vec2 x = start.at.position + h * half;
    const auto s = field.sample(x);
    const double speed2 =
        0.5 * (squared_length_in_space(start.sample, half) + squared_length_in_space(s, half));
    const double way = h * std::sqrt(speed2);
    if (!field.turns()) {
      const core::Vec2 v = field.kick(s, half, k);
      return {{x, v}, h, way, {}, field.gain(s, x, {x, v}, h)};
    }
    // The midpoint rule.
    const core::Vec2 h1 = field.heading();
    const core::Vec2 middle = h1 + k * heading_rate(h1, start.at.velocity);
    const core::Vec2 heading = unit(h1 + h * heading_rate(middle, half));
    const core::Vec2 v = field.kick(s, half, k, heading);
    return {{x, v}, h, way, heading, field.gain(s, x, {x, v}, h)};
  }
};

/// The default; see nystrom.h. Order 4, three surface calls a step with a1's.
struct Nystrom4 {
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = true;
  static constexpr int kSamples = 4;
  template <typename Start, typename Field>
  [[gnu::always_inline]] inline StepResult step(const Start& start, const Field& field, double h) const {
    const auto sample = [&](core::Vec2 x) { return field.sample(x); };
    if (field.turns()) return turning_step(start, field, h, sample);
    return straight_step(start, field, h, sample);
  }

  /// sample(x): the surface.
  template <typename Start, typename Field, typename Sample>
  [[gnu::always_inline]] static inline StepResult straight_step(const Start& start, const Field& field,
                                                                double h, const Sample& sample) {
    return nystrom4(
        start.at, start.acceleration, h, sample,
        [&](const auto& s, core::Vec2 v) { return field.accelerate(s, v); }, gain_of(field, h));
  }

  template <typename Start, typename Field, typename Sample>
  [[gnu::noinline]] static StepResult turning_step(const Start& start, const Field& field, double h,
                                                   const Sample& sample) {
    return nystrom4_turning(
        start.at, field.heading(), start.acceleration, h, sample,
        [&](const auto& s, core::Vec2 v, core::Vec2 heading) { return field.accelerate(s, v, heading); },
        gain_of(field, h));
  }

 private:
  template <typename Field>
  [[gnu::always_inline]] static inline auto gain_of(const Field& field, double h) {
    return [&field, h](const auto& s, core::Vec2 place, const Motion& end) {
      return field.gain(s, place, end, h);
    };
  }
};

}  // namespace woodlouse::physics
