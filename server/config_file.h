// The options of a --config file: one flat JSON object, keys as the options with `_` for `-`:
//     {"map": ["maps/volcano.json"], "listen": ":7777", "tick_hz": 60, "bots": 3}
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/error.h"

namespace woodlouse::server {

/// An option's name without dashes in front, and its values as one would type them.
using FileOption = std::pair<std::string, std::vector<std::string>>;

/// Errors: the file cannot be read, is no JSON object, or a value is neither text, number nor a list of them.
core::Expected<std::vector<FileOption>> read_config_file(const std::filesystem::path& file);

}  // namespace woodlouse::server
