// A team of threads that sleep until there is work. Nobody waits for one of them to wake: the caller does
// every part that none has begun, and returns when the last begun one is done.
//
// Each member begins with a share of its own of the parts, the same from job to job, so that what it works on
// stays in its core's cache; then it looks for what is left of the others'. Before it sleeps a helper looks
// out for the next job for kSpin, as a tick has two of them, one right after the other.
#pragma once

#include <atomic>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "shared/core/team.h"

namespace woodlouse::core {

/// Adds threads that call work(first) to work(end - 1). Where the system gives no more of them, those are
/// left out: for work that others do as well.
template <typename F>
void start_threads(std::vector<std::jthread>& threads, std::size_t first, std::size_t end, const F& work) {
  threads.reserve(threads.size() + end - first);
  try {
    for (std::size_t k = first; k < end; ++k) threads.emplace_back([work, k] { work(k); });
  } catch (const std::system_error&) {
    assert(threads.size() < threads.capacity());
  }
}

class ThreadTeam final : public Team {
 public:
  static constexpr std::size_t kMostThreads = 64;
  /// Who waits for the others looks for so long before it sleeps: to be woken takes a thread some 40 us, and
  /// whoever wakes it 15. A tick of 3000 lice on two threads, back to back: 1.3 times as fast as on one
  /// without looking, 1.6 with it.
  static constexpr std::chrono::microseconds kSpin{60};

  /// size: 1..kMostThreads; starts one thread fewer, or as many of them as the system gives.
  explicit ThreadTeam(std::size_t size, Cut cut = Cut::kWorthIt);
  /// REQUIRES that nobody is in try_run().
  ~ThreadTeam() override;

  [[nodiscard]] bool try_run(std::size_t parts, const Work& work) override;

 private:
  /// On a cache line of its own. Its share of the parts is set while no helper is in a job.
  struct alignas(64) Member {
    std::atomic<std::size_t> next{0};  ///< the first part of the share that nobody has taken
    std::size_t end = 0;
    std::atomic<int> processor{-1};  ///< that it was on last; -1: unknown
    std::condition_variable wanted;  ///< a helper's: there is a job for it, or the end
  };
  struct Job {
    const Work& work;
    const std::size_t members;            ///< of whom it is shared out to
    std::atomic<std::size_t> helpers{0};  ///< in it now; changes under mutex_
  };

  void share_out(std::size_t parts, std::size_t members);
  void help(std::size_t member);
  void work_off(const Job& job, std::size_t member) noexcept;
  void keep_apart(std::size_t member);

  std::mutex taken_;  ///< held by the caller whose job it is
  std::vector<Member> members_;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable last_helper_left_;
  Job* job_ = nullptr;                    ///< that helpers may enter
  std::atomic<std::uint64_t> opened_{0};  ///< jobs so far: a helper enters each at most once
  bool ends_ = false;

  std::vector<std::jthread> helpers_;
};

}  // namespace woodlouse::core
