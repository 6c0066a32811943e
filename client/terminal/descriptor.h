// A file descriptor that closes itself.
#pragma once

#include <unistd.h>

#include <utility>

namespace woodlouse::client {

class Descriptor {
 public:
  /// fd: taken over; -1: none.
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

}  // namespace woodlouse::client
