#include "bench/lab/report/progress.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <utility>

namespace woodlouse::lab {

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(std::max<std::size_t>(total, 1)),
      on_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (on_terminal_) std::cerr << "\r\x1b[K" << std::flush;
}

void Progress::advance(std::size_t steps) {
  done_ = std::min(done_ + steps, total_);
  const std::size_t now = done_ * 1000 / total_;
  if (!on_terminal_ || now == shown_) return;
  shown_ = now;
  constexpr std::size_t kWidth = 40;
  const std::size_t full = now * kWidth / 1000;
  std::cerr << '\r' << what_ << " [" << std::string(full, '#') << std::string(kWidth - full, '.') << "] "
            << now / 10 << " %" << std::flush;
}

}  // namespace woodlouse::lab
