// Bytes into a file.
#pragma once

#include <filesystem>
#include <memory>

#include "shared/core/byte_sink.h"

namespace woodlouse::core {

/// Creates the file, over one that is there. Errors: where = the file, what = the system's words.
Expected<std::unique_ptr<ByteSink>> open_file_sink(const std::filesystem::path& file);

}  // namespace woodlouse::core
