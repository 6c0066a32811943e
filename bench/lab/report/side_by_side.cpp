#include "bench/lab/report/side_by_side.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "bench/lab/report/race.h"

namespace woodlouse::lab {

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void()>& done) {
  assert(work && done);
  std::atomic<std::size_t> next{0};
  std::mutex mutex;  // of what follows, and of done()
  std::exception_ptr failure;
  const auto take_turns = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        work(i);
        const std::lock_guard lock(mutex);
        done();
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = count;  // nothing more begins
    }
  };
  {
    const AnyCore any_core;  // whoever times things has pinned this thread, and others inherit that
    std::vector<std::jthread> others;
    const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
    for (std::size_t k = 1; k < std::min(processors, count); ++k) others.emplace_back(take_turns);
    take_turns();
  }
  if (failure) std::rethrow_exception(failure);
  assert(next >= count);
}

}  // namespace woodlouse::lab
