// A thread that does jobs one after the other, behind a queue with an end. Whoever hands over a job never
// waits, nor does whoever ends the thread: one that stands in a write() can't be joined. So the thread holds
// all that its jobs use, and who has waited long enough leaves it behind.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "server/timing/clock.h"

namespace woodlouse::server {

/// Any thread, every function.
class JobThread {
 public:
  using Job = std::function<void()>;

  /// most: jobs that wait. tend: called on the thread, at the latest `period` after a job, and last of all.
  /// Throws std::system_error where the system gives no thread.
  JobThread(std::size_t most, Duration period, Job tend);
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;
  /// close(), without waiting.
  ~JobThread();

  /// False, and nothing done, where `most` wait, or after the last one.
  [[nodiscard]] bool post(Job job);
  /// Behind all that wait, however many; none comes after it.
  void post_last(Job job);
  /// None comes any more; those that wait are done, then the thread ends.
  void close();
  [[nodiscard]] std::size_t waiting() const;
  /// Whether the thread has ended by then: it holds nothing of its jobs any more.
  [[nodiscard]] bool wait_until(Time latest) const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;  ///< with the thread
};

}  // namespace woodlouse::server
