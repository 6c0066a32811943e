// The options of recordings.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "server/watchers/recordings.h"
#include "shared/core/error.h"

namespace CLI {
class App;
}

namespace woodlouse::server {

/// Of which a file may be told; shorter than two keyframes it is of no use.
inline constexpr std::chrono::seconds kLeastRecordEvery{10};

/// As typed, before they are checked.
struct TypedRecord {
  std::optional<std::string> record, every, keep;
};

void add_record_options(CLI::App& app, TypedRecord& typed);

/// Nothing: nothing is recorded. Errors: where = the option.
core::Expected<std::optional<RecordSettings>> checked_record(const TypedRecord& typed, std::size_t rooms);

}  // namespace woodlouse::server
