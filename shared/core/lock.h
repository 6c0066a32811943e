// A mutex where there are threads. Built without them (preset freestanding: a browser), nothing to lock.
#pragma once

#ifndef WOODLOUSE_FREESTANDING
#include <mutex>
#endif

namespace woodlouse::core {

#ifdef WOODLOUSE_FREESTANDING
class Mutex {
 public:
  void lock() {}
  void unlock() {}
};

class [[nodiscard]] Lock {
 public:
  explicit Lock(Mutex& mutex) : mutex_(mutex) { mutex_.lock(); }
  ~Lock() { mutex_.unlock(); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  Mutex& mutex_;
};
#else
using Mutex = std::mutex;
using Lock = std::lock_guard<std::mutex>;
#endif

}  // namespace woodlouse::core
