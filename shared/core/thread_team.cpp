#include "shared/core/thread_team.h"

#include <cassert>

namespace woodlouse::core {

ThreadTeam::ThreadTeam(std::size_t size, Cut cut) : Team(size, cut), shares_(size) {
  assert(size <= kMostThreads);
  for (std::size_t member = 1; member < size; ++member)
    helpers_.emplace_back([this, member] { help(member); });
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(mutex_);
    assert(job_ == nullptr);
    ends_ = true;
  }
  job_opened_.notify_all();
}

bool ThreadTeam::try_run(std::size_t parts, const Work& work) {
  const std::unique_lock taken(taken_, std::try_to_lock);
  if (!taken.owns_lock()) return false;
  for (std::size_t member = 0; member < size(); ++member) {
    shares_[member].next.store(member * parts / size(), std::memory_order_relaxed);
    shares_[member].end = (member + 1) * parts / size();
  }
  Job job{work};
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
    ++opened_;
  }
  job_opened_.notify_all();
  work_off(work, 0);
  std::unique_lock lock(mutex_);
  job_ = nullptr;  // whoever wakes now finds nothing to do
  last_helper_left_.wait(lock, [&] { return job.helpers == 0; });
  return true;
}

void ThreadTeam::help(std::size_t member) {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    job_opened_.wait(lock, [&] { return ends_ || (job_ != nullptr && opened_ != seen); });
    if (ends_) return;
    seen = opened_;
    Job& job = *job_;
    ++job.helpers;
    lock.unlock();
    work_off(job.work, member);
    lock.lock();
    if (--job.helpers == 0) last_helper_left_.notify_one();
  }
}

/// noexcept: what a part throws ends the program, as a tick never throws.
void ThreadTeam::work_off(const Work& work, std::size_t member) noexcept {
  for (std::size_t turn = 0; turn < size(); ++turn) {
    Share& share = shares_[(member + turn) % size()];
    for (;;) {
      const std::size_t part = share.next.fetch_add(1, std::memory_order_relaxed);
      if (part >= share.end) break;
      work(part);
    }
  }
}

}  // namespace woodlouse::core
