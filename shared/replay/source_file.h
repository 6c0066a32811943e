// Recordings in files.
#pragma once

#include <filesystem>

#include "shared/replay/source.h"

namespace woodlouse::replay {

/// The recording in that file; a map that it only names is looked for beside it, then under the path it was
/// recorded with. The file is opened when a stream is.
ReplaySource source_of_file(const std::filesystem::path& file);

}  // namespace woodlouse::replay
