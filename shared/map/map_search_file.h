// Maps by their names: those that came with the program.
#pragma once

#include <filesystem>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::map {

/// The file itself, if `word` is one; else the map of that name, with or without .json, of the folder
/// share/woodlouse/maps of where the program is installed, or of the source tree it was built in. Errors:
/// none.
core::Expected<std::filesystem::path> find_map(const std::string& word);

}  // namespace woodlouse::map
