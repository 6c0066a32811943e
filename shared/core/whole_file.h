// A file's bytes, bounded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::core {

/// Whether there is a file that can be read to an end. Errors: there is none; it is a folder, or a pipe, a
/// device or a socket, which may keep whoever opens it waiting or never end. Ask before opening what somebody
/// else named.
Expected<void> check_regular_file(const std::filesystem::path& file);

/// The whole file. Errors: it can't be opened or read, it is no regular file (check_regular_file), it is
/// longer than max_bytes.
Expected<std::string> read_whole_file(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace woodlouse::core
