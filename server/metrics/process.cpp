#include "server/metrics/process.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <charconv>
#include <chrono>
#include <string_view>
#include <system_error>

namespace woodlouse::server {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

struct Process::Proc {
  int memory = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  DIR* descriptors = ::opendir("/proc/self/fd");

  Proc() = default;
  Proc(const Proc&) = delete;
  Proc& operator=(const Proc&) = delete;
  ~Proc() {
    if (memory >= 0) ::close(memory);
    if (descriptors != nullptr) ::closedir(descriptors);
  }

  /// "total resident ...", in pages.
  [[nodiscard]] std::optional<std::uint64_t> resident_bytes() const {
    std::array<char, 256> bytes{};
    const ssize_t size = memory < 0 ? -1 : ::pread(memory, bytes.data(), bytes.size(), 0);
    const long page = ::sysconf(_SC_PAGESIZE);
    if (size <= 0 || page <= 0) return std::nullopt;
    std::string_view text(bytes.data(), static_cast<std::size_t>(size));
    text.remove_prefix(std::min(text.size(), text.find(' ')));
    if (!text.empty()) text.remove_prefix(1);
    std::uint64_t pages = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), pages).ec != std::errc{}) return std::nullopt;
    return pages * static_cast<std::uint64_t>(page);
  }

  [[nodiscard]] std::optional<std::uint64_t> open_descriptors() const {
    if (descriptors == nullptr) return std::nullopt;
    ::rewinddir(descriptors);
    std::uint64_t count = 0;
    while (const dirent* entry = ::readdir(descriptors)) count += entry->d_name[0] != '.';
    return count;
  }
};

Process::Process()
    : start_s_(std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count()),
      proc_(std::make_unique<Proc>()) {
  assert(start_s_ > 0);
}

Process::~Process() = default;

ProcessFigures Process::figures() const {
  const std::lock_guard lock(mutex_);
  ProcessFigures result;
  result.start_s = start_s_;
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) == 0) result.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.resident_bytes = proc_->resident_bytes();
  result.open_descriptors = proc_->open_descriptors();
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    result.max_descriptors = limit.rlim_cur;
  assert(result.cpu_s >= 0);
  return result;
}

}  // namespace woodlouse::server
