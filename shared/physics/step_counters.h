// What the steps of a world have done; for logs and metrics, no part of the state.
#pragma once

#include <cstdint>

namespace woodlouse::physics {

struct StepCounters {
  std::uint64_t louse_steps = 0;  ///< lice stepped, summed over ticks
  std::uint64_t left = 0;         ///< of those, whom the lanes left to the scalar step (batch.h)
  std::uint64_t sub_steps = 0;    ///< Nystrom steps taken for them
  std::uint64_t capped = 0;       ///< sub-steps that wanted to be shorter than the caps allow
  std::uint64_t samples = 0;      ///< of the surface with the acceleration there, searches included
  std::uint64_t bounces = 0;      ///< impacts on a wall
  std::uint64_t flights = 0;      ///< take-offs
  std::uint64_t stops = 0;        ///< lice brought to rest by friction

  StepCounters& operator+=(const StepCounters& other) {
    louse_steps += other.louse_steps;
    left += other.left;
    sub_steps += other.sub_steps;
    capped += other.capped;
    samples += other.samples;
    bounces += other.bounces;
    flights += other.flights;
    stops += other.stops;
    return *this;
  }
};

}  // namespace woodlouse::physics
