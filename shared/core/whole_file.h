// A file's bytes, bounded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::core {

/// The whole file. Errors: it can't be opened or read, it is no regular file, it is longer than max_bytes.
Expected<std::string> read_whole_file(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace woodlouse::core
