#include "server/watchers/job_thread.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace woodlouse::server {

struct JobThread::Shared {
  Shared(std::size_t most_waiting, Duration tended_every, Job tending)
      : most(most_waiting), period(tended_every), tend(std::move(tending)) {}

  const std::size_t most;
  const Duration period;
  Job tend;  ///< the thread's
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Job> jobs;
  bool is_closed = false;
  bool has_ended = false;

  void work();
  [[nodiscard]] Job next(std::optional<Time> latest);
};

/// None: it is `latest`, or the last one is done.
JobThread::Job JobThread::Shared::next(std::optional<Time> latest) {
  std::unique_lock lock(mutex);
  const auto is_ready = [this] { return !jobs.empty() || is_closed; };
  if (latest)
    changed.wait_until(lock, *latest, is_ready);
  else
    changed.wait(lock, is_ready);
  if (jobs.empty()) return nullptr;
  Job job = std::move(jobs.front());
  jobs.pop_front();
  return job;
}

void JobThread::Shared::work() {
  std::optional<Time> tend_at;
  const auto is_over = [this] {
    const std::lock_guard lock(mutex);
    return is_closed && jobs.empty();
  };
  while (!is_over()) {
    if (Job job = next(tend_at)) {
      job();
      if (!tend_at) tend_at = Clock::now() + period;
    }
    if (!tend_at || Clock::now() < *tend_at) continue;
    tend();
    tend_at.reset();
  }
  tend();
  tend = nullptr;
  const std::lock_guard lock(mutex);
  has_ended = true;
  changed.notify_all();
}

JobThread::JobThread(std::size_t most, Duration period, Job tend)
    : shared_(std::make_shared<Shared>(most, period, std::move(tend))) {
  std::thread([shared = shared_] { shared->work(); }).detach();
}

JobThread::~JobThread() { close(); }

bool JobThread::post(Job job) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->is_closed || shared_->jobs.size() >= shared_->most) return false;
  shared_->jobs.push_back(std::move(job));
  shared_->changed.notify_all();
  return true;
}

void JobThread::post_last(Job job) {
  const std::lock_guard lock(shared_->mutex);
  if (!shared_->is_closed) shared_->jobs.push_back(std::move(job));
  shared_->is_closed = true;
  shared_->changed.notify_all();
}

void JobThread::close() {
  const std::lock_guard lock(shared_->mutex);
  shared_->is_closed = true;
  shared_->changed.notify_all();
}

std::size_t JobThread::waiting() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->jobs.size();
}

bool JobThread::wait_until(Time latest) const {
  std::unique_lock lock(shared_->mutex);
  return shared_->changed.wait_until(lock, latest, [this] { return shared_->has_ended; });
}

}  // namespace woodlouse::server
