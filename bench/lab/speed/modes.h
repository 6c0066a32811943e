// What the rules of play take of a tick.
#pragma once

#include <filesystem>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// Each mode of each map of `folder` (empty: the project's own): a tick with its hash, of 20, 200 and 1,000
/// lice that are pushed about, and what the rules take within it; medians. Writes lab-speed-modes.csv.
core::Expected<void> measure_modes(const std::filesystem::path& folder, const Output& output);

}  // namespace woodlouse::lab
