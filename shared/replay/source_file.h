// Recordings in files.
#pragma once

#include <filesystem>

#include "shared/replay/source.h"

namespace woodlouse::replay {

/// The recording in that file; a map that it only names is looked for beside it, then in `maps`. The file is
/// opened when a stream is; it must be a regular one.
ReplaySource source_of_file(const std::filesystem::path& file, const std::filesystem::path& maps = {});

}  // namespace woodlouse::replay
