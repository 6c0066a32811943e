// Where a recording's bytes come from: a file, or a text in memory. Compressed ones are told by their first
// bytes and unpacked on the way.
#pragma once

#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::replay {

/// Opens as many streams on one recording as are wanted: text, that can be sought in by the byte.
struct ReplaySource {
  std::string name;              ///< in errors
  std::filesystem::path folder;  ///< where a map that is only named is looked for first
  std::function<core::Expected<std::unique_ptr<std::istream>>()> open;

  static ReplaySource of_file(const std::filesystem::path& file);
  /// `bytes`: plain or compressed.
  static ReplaySource of_bytes(std::string bytes, std::string name, const std::filesystem::path& folder = {});
};

}  // namespace woodlouse::replay
