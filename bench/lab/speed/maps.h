// A tick of the shipped maps, each with its own forces, walls and contact: what a server pays for a crowd.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "bench/lab/report/output.h"
#include "shared/map/map_definition.h"

namespace woodlouse::lab {

/// The maps of a folder, by name; empty: the project's own.
core::Expected<std::vector<std::shared_ptr<const map::Map>>> maps_of(std::filesystem::path folder);

/// The maps of `folder` (empty: the project's own), by name: every instruction set this machine has, thrusts
/// held and new each tick, with the state hash and without; then from one louse to a million. Writes
/// lab-speed-maps.csv and draws the latter.
core::Expected<void> measure_maps(const std::filesystem::path& folder, const Output& output);

/// The same maps by one thread and by two, in turns, wall time: 1,000 lice, 10,000 and 100,000. Writes
/// lab-speed-threads.csv.
core::Expected<void> measure_threads(const std::filesystem::path& folder, const Output& output);

}  // namespace woodlouse::lab
