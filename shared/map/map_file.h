// Maps in files; what is in one is map_text.h's.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "shared/core/error.h"
#include "shared/map/map_text.h"

namespace woodlouse::map {

/// The map of a file. Errors: where = "file:line: field", what, hint.
core::Expected<std::shared_ptr<const Map>> load_map(const std::filesystem::path& file);

/// The same for a file that the user did not name himself: it must lie in `folder`, wherever links lead
/// (core/input_file.h).
core::Expected<std::shared_ptr<const Map>> load_map_within(const std::filesystem::path& folder,
                                                           const std::filesystem::path& file);

/// What is wrong with a map file, the first hundred and how many more, for `woodlouse-server check`; empty:
/// nothing.
std::vector<core::Error> check_map(const std::filesystem::path& file);

}  // namespace woodlouse::map
