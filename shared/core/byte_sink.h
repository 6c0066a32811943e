// Where bytes go: a file (sink_file.h), a test's memory, a sink that fails when a test wants it to.
#pragma once

#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::core {

/// One thread at a time. After an error nothing more is written.
class ByteSink {
 public:
  ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;
  virtual ~ByteSink() = default;

  /// Behind what was written before; whoever reads it sees it when this returns. Errors: what = the system's
  /// words.
  [[nodiscard]] virtual Expected<void> write(std::string_view bytes) = 0;
  /// Once, last of all: everything has arrived, or the error.
  [[nodiscard]] virtual Expected<void> close() = 0;
};

}  // namespace woodlouse::core
