// What a file is that is no grid we read, told by its first bytes, and the command that makes one of it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::elevation {

inline constexpr std::size_t kKindBytes = 16;  ///< of a file's beginning are enough

/// Nothing: it may be a grid of text. `path` names the file in the error and in its command.
std::optional<core::Error> foreign_grid(std::string_view first_bytes, const std::string& path);

}  // namespace woodlouse::elevation
