// The time that a race's author says is to be beaten, and the ghost beside its map that proves it:
// ghosts/ring.json of ring.json. Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"

namespace woodlouse::server {

/// Of a map that is fine: drives its ghost again and says what that proves, or that nothing does; empty: the
/// race states no time and has no ghost. Errors: the ghost can't be read or is none, it does not re-run, or
/// its time is not what the map states, rounded up to whole ms. REQUIRES a map with a race.
core::Expected<std::string> judge_author_time(const map::Map& map, const std::filesystem::path& map_file);

}  // namespace woodlouse::server
