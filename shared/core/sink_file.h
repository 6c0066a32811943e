// Bytes into a file that was not there before.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "shared/core/byte_sink.h"

namespace woodlouse::core {

struct NewFile {
  std::unique_ptr<ByteSink> sink;
  std::filesystem::path path;  ///< what it is called: as asked for, or numbered
  bool is_numbered = false;
};

inline constexpr std::size_t kMaxFileNumber = 9999;

/// game.ndjson.zst and 2: game.2.ndjson.zst. The number stands before the extension, and .zst is not all of
/// it.
std::filesystem::path numbered(const std::filesystem::path& file, std::size_t number);

/// Creates the file; where one of that name is there already, the first of numbered(file, 1), (file, 2), ...
/// that is not: nothing is ever written over. A device or a pipe that somebody reads is written into as it
/// is; a pipe that is full and not read from for half a second is an error of the sink's. Errors: where = the
/// file, what = the system's words, or that all numbers are taken.
Expected<NewFile> create_file(const std::filesystem::path& file);

/// Whether a sink of create_file() has it open, in this process or another. The system forgets it with the
/// process.
bool is_being_written(const std::filesystem::path& file);

}  // namespace woodlouse::core
