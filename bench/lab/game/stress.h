// Maps made by chance: what breaks a stated bound, and the seed that makes it again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// `count` maps, of the seeds from `seed` on: knots 1 mm to 10 km apart, slopes to 60 degrees, any gravity,
/// friction, contact, rim and steering, 1 to 1000 Hz, by every integrator. Prints the worst of each with its
/// seed and how many are beyond what docs/physics.md states of the rooms' methods; writes
/// lab-stability-random.csv, a row a map and integrator that is among the worst or beyond a bound.
core::Expected<void> measure_stress(std::size_t count, std::uint64_t seed, const Output& output);

}  // namespace woodlouse::lab
