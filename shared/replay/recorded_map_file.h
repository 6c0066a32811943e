// The file of a map that a recording only names.
#pragma once

#include <filesystem>

#include "shared/replay/source.h"

namespace woodlouse::replay {

/// The map that the header names. Errors: no such file, not a map. Whether it is the recorded one
/// recorded_map() asks.
core::Expected<MapPointer> load_named_map(const Header& header, const std::filesystem::path& folder);

/// The file of a map that is only named: the one in `folder`, where there is one; else as it was recorded.
/// Empty where the header has the map itself.
std::filesystem::path map_file_of(const Header& header, const std::filesystem::path& folder);

}  // namespace woodlouse::replay
