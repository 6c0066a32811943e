// Run time against error on the maps as they are played.
#pragma once

#include <filesystem>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// Every map of `folder` (empty: the project's own) with its own physics, walls and contact, each of kPlays,
/// at each of kGameRates, by the rooms' methods, in lanes and by plain doubles, and rivals: against the
/// reference. Writes lab-precision-maps.csv and lab-precision-maps-time.csv and draws both.
core::Expected<void> measure_game_precision(const std::filesystem::path& folder, const Output& output);

}  // namespace woodlouse::lab
