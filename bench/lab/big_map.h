// A map too big to load, written to a temporary file, with lice that wander on it: how many tiles that
// builds, what it keeps in memory, and how long the first state takes.
#pragma once

#include <cstddef>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

struct BigMapUsage {
  double knots = 0.0;  ///< a side
  double lice = 0.0;
  double open_seconds = 0.0;  ///< from opening the file to every louse's first step
  double tiles = 0.0;         ///< built
  double all_tiles = 0.0;
  double resident_mb = 0.0;  ///< of the process at the end, the file's page cache not counted
  double grown_mb = 0.0;     ///< by opening and running
  double cached_mb = 0.0;    ///< of the file in the page cache at the end
  double ns_per_step = 0.0;  ///< a louse-step, tiles being built included
};

/// REQUIRES room for 4 knots^2 bytes in the temporary folder.
core::Expected<BigMapUsage> use_big_map(std::size_t knots, std::size_t lice, double seconds);

}  // namespace woodlouse::lab
