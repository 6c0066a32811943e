// What the system says of this process.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

namespace woodlouse::server {

struct ProcessFigures {
  double start_s = 0;                           ///< since 1970
  double cpu_s = 0;                             ///< user and system, of all threads
  std::optional<std::uint64_t> resident_bytes;  ///< none: /proc does not tell
  std::optional<std::uint64_t> open_descriptors;
  std::optional<std::uint64_t> max_descriptors;  ///< none: there is no limit
};

/// Any thread: a lock is held while /proc is read, some tens of microseconds. Opens nothing then: it has to
/// tell how many descriptors there are where none is left.
class Process {
 public:
  /// It starts now.
  Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  [[nodiscard]] ProcessFigures figures() const;

 private:
  struct Proc;
  const double start_s_;
  mutable std::mutex mutex_;
  std::unique_ptr<Proc> proc_;
};

}  // namespace woodlouse::server
