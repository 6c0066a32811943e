// A file's bytes, bounded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::core {

/// The whole file. Errors: those of InputFile::open (input_file.h), it can't be read, it is longer than
/// max_bytes.
Expected<std::string> read_whole_file(const std::filesystem::path& file, std::size_t max_bytes);

/// The same for what the user did not name himself: InputFile::open_within.
Expected<std::string> read_whole_file_within(const std::filesystem::path& folder,
                                             const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace woodlouse::core
