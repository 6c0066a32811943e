// Replaces a file, wholly or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::scenario {

/// Writes beside the file and puts the result in its place. Gives what went wrong; then the file is as it
/// was.
std::optional<core::Error> write_whole_file(const std::filesystem::path& file, std::string_view text);

}  // namespace woodlouse::scenario
