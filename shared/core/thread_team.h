// A team of threads that sleep until there is work. Nobody waits for one of them to wake: the caller does
// every part that none has begun, and returns when the last begun one is done.
//
// Each member begins with a share of its own of the parts, the same from job to job, so that what it works on
// stays in its core's cache; then it looks for what is left of the others'.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "shared/core/team.h"

namespace woodlouse::core {

class ThreadTeam final : public Team {
 public:
  static constexpr std::size_t kMostThreads = 64;

  /// size: 1..kMostThreads; starts one thread fewer.
  explicit ThreadTeam(std::size_t size, Cut cut = Cut::kWorthIt);
  /// REQUIRES that nobody is in try_run().
  ~ThreadTeam() override;

  [[nodiscard]] bool try_run(std::size_t parts, const Work& work) override;

 private:
  /// A member's share of the parts: the next one that nobody has taken. On a cache line of its own.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  struct Job {
    const Work& work;
    std::size_t helpers = 0;  ///< in it now; mutex_ guards it
  };

  void help(std::size_t member);
  void work_off(const Work& work, std::size_t member) noexcept;

  std::mutex taken_;  ///< held by the caller whose job it is
  /// Written while no helper is in a job, by who holds taken_; `next` by all who are in it.
  std::vector<Share> shares_;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable job_opened_;
  std::condition_variable last_helper_left_;
  Job* job_ = nullptr;        ///< which helpers may enter
  std::uint64_t opened_ = 0;  ///< jobs so far: a helper enters each at most once
  bool ends_ = false;

  std::vector<std::jthread> helpers_;
};

}  // namespace woodlouse::core
