#include "shared/core/thread_team.h"

#ifdef __linux__
#include <sched.h>
#include <unistd.h>
#endif

#include <cassert>

namespace woodlouse::core {
namespace {

void pause_briefly() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Looks until is_over() or for ThreadTeam::kSpin.
template <typename F>
bool spin_until(const F& is_over) {
  constexpr int kLooksPerClock = 20;
  const auto end = std::chrono::steady_clock::now() + ThreadTeam::kSpin;
  do {
    for (int k = 0; k < kLooksPerClock; ++k) {
      if (is_over()) return true;
      pause_briefly();
    }
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

ThreadTeam::ThreadTeam(std::size_t size, Cut cut) : Team(size, cut), members_(size) {
  assert(size <= kMostThreads);
  start_threads(helpers_, 1, size, [this](std::size_t member) { help(member); });
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(mutex_);
    assert(job_ == nullptr);
    ends_ = true;
  }
  for (Member& member : members_) member.wanted.notify_one();
}

void ThreadTeam::share_out(std::size_t parts, std::size_t members) {
  for (std::size_t member = 0; member < members; ++member) {
    members_[member].next.store(member * parts / members, std::memory_order_relaxed);
    members_[member].end = (member + 1) * parts / members;
  }
}

bool ThreadTeam::try_run(std::size_t parts, const Work& work) {
  const std::unique_lock taken(taken_, std::try_to_lock);
  if (!taken.owns_lock()) return false;
  Job job{work, members(parts)};
  share_out(parts, job.members);
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
    ++opened_;
  }
  for (std::size_t helper = 1; helper < job.members; ++helper) members_[helper].wanted.notify_one();
  keep_apart(0);
  work_off(job, 0);
  const auto is_done = [&job] { return job.helpers.load() == 0; };
  {
    const std::lock_guard lock(mutex_);
    job_ = nullptr;  // whoever wakes now finds nothing to do
    if (is_done()) return true;
  }
  spin_until(is_done);
  std::unique_lock lock(mutex_);
  last_helper_left_.wait(lock, is_done);
  return true;
}

void ThreadTeam::help(std::size_t member) {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  const auto is_wanted = [&] {
    return ends_ || (job_ != nullptr && opened_ != seen && member < job_->members);
  };
  for (;;) {
    if (!is_wanted()) {
      lock.unlock();
      spin_until([&] { return opened_.load(std::memory_order_relaxed) != seen; });
      lock.lock();
    }
    members_[member].wanted.wait(lock, is_wanted);
    if (ends_) return;
    seen = opened_;
    Job& job = *job_;
    ++job.helpers;
    lock.unlock();
    keep_apart(member);
    work_off(job, member);
    lock.lock();
    if (--job.helpers == 0) last_helper_left_.notify_one();
  }
}

/// noexcept: what a part throws ends the program, as a tick never throws.
void ThreadTeam::work_off(const Job& job, std::size_t member) noexcept {
  for (std::size_t turn = 0; turn < job.members; ++turn) {
    Member& owner = members_[(member + turn) % job.members];
    for (;;) {
      const std::size_t part = owner.next.fetch_add(1, std::memory_order_relaxed);
      if (part >= owner.end) break;
      job.work(part);
    }
  }
}

/// There are kernels that wake a helper on the processor of who called it, though another is idle, and there
/// it stays for a millisecond or more: longer than a tick takes. So a helper that finds itself with a member
/// before it moves to where none of these was last. Where the process may run is asked each time.
void ThreadTeam::keep_apart([[maybe_unused]] std::size_t member) {
#ifdef __linux__
  const int here = ::sched_getcpu();
  members_[member].processor.store(here, std::memory_order_relaxed);
  cpu_set_t others;
  bool is_shared = false;
  CPU_ZERO(&others);
  for (std::size_t k = 0; k < member; ++k) {
    const int there = members_[k].processor.load(std::memory_order_relaxed);
    if (there < 0 || there >= CPU_SETSIZE) continue;
    is_shared |= there == here;
    CPU_SET(there, &others);
  }
  cpu_set_t allowed, free;
  if (!is_shared || ::sched_getaffinity(::getpid(), sizeof allowed, &allowed) != 0) return;
  CPU_AND(&others, &others, &allowed);
  CPU_XOR(&free, &allowed, &others);
  // Where there is none, or it may not, it stays: slower, and nothing else.
  if (CPU_COUNT(&free) > 0) static_cast<void>(::sched_setaffinity(0, sizeof free, &free));
#endif
}

}  // namespace woodlouse::core
