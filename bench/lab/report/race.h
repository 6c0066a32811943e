// Times several ways of doing the same thing against each other, in one run: each round runs a block of each,
// each fourth one of what takes as long as ten, and what counts is the median of the blocks.
//
// Measured is the thread's own processor time, so that a machine that also does other things does not count
// as ours; caches that others emptied still do. The thread is pinned to one core.
#pragma once

#include <sched.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

struct Contestant {
  std::string name;
  /// Does the thing `count()` times over.
  std::function<void()> run;
  double count = 1.0;
};

/// Keeps a result alive that nobody reads.
template <typename T>
inline void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

struct Timing {
  double median_ns = 0.0;  ///< of one of the `count`
  double best_ns = 0.0;
};

/// Keeps the thread on the core it runs on.
void pin_to_core();

/// While it lives the thread may run on every core again, and so may those that it starts.
class AnyCore {
 public:
  AnyCore();
  ~AnyCore();
  AnyCore(const AnyCore&) = delete;
  AnyCore& operator=(const AnyCore&) = delete;

 private:
  cpu_set_t before_;
};

/// kWall: the time that passes, for what several threads do.
enum class Clock { kProcessor, kWall };

/// The times, in the order of the contestants. `what` labels the progress bar.
std::vector<Timing> race(const std::vector<Contestant>& contestants, Effort effort, const std::string& what,
                         Clock clock = Clock::kProcessor);

}  // namespace woodlouse::lab
