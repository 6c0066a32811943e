// The map a recording was played on.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/replay/format.h"

namespace woodlouse::replay {

/// Proven to be it by its hash. `source` names the recording in errors; a map that it only names is looked
/// for in `folder`, then under the path it was recorded with.
core::Expected<std::shared_ptr<const map::Map>> load_recorded_map(const Header& header,
                                                                  const std::string& source,
                                                                  const std::filesystem::path& folder);

/// The file of a map that is only named: the one in `folder`, where there is one; else as it was recorded.
/// Empty where the header has the map itself.
std::filesystem::path map_file_of(const Header& header, const std::filesystem::path& folder);

}  // namespace woodlouse::replay
