// A file's bytes, bounded; and a file replaced as a whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::core {

/// The whole file. Errors: those of InputFile::open (input_file.h), it can't be read, it is longer than
/// max_bytes.
Expected<std::string> read_whole_file(const std::filesystem::path& file, std::size_t max_bytes);

/// The same for what the user did not name himself: InputFile::open_within.
Expected<std::string> read_whole_file_within(const std::filesystem::path& folder,
                                             const std::filesystem::path& file, std::size_t max_bytes);

/// Puts a file of these bytes in the place of `file`, wholly or not at all, with the mode of the one that was
/// there, or 0600. Others may do the same at the same time: each writes beside it under a name of his own,
/// and the last one's is there in the end. Not forced onto the disk. Error: why not; then the file is as it
/// was.
Expected<void> replace_whole_file(const std::filesystem::path& file, std::string_view text);

}  // namespace woodlouse::core
