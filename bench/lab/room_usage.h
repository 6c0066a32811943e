// What a server's room costs where nothing moves: the server is run as a process of its own, and its
// processor time is read from the system.
#pragma once

#include <filesystem>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

enum class Population { kEmpty, kResting };

struct RoomUsage {
  double percent_of_core = 0.0;
  double seconds = 0.0;  ///< measured
  double lice = 0.0;
};

/// programs: the folder of woodlouse-server and woodlouse-swarm. Resting lice are the swarm's, connected and
/// without inputs, on flat ground. Errors: a program is missing, the server does not start.
core::Expected<RoomUsage> use_room(const std::filesystem::path& programs, Population population,
                                   double seconds);

}  // namespace woodlouse::lab
