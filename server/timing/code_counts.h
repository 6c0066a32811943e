// How often something had to do with each of the codes of protocol/codes.h.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace woodlouse::server {

/// Any thread, without a lock.
class CodeCounts {
 public:
  static constexpr std::size_t kMost = 64;  ///< codes that there may be

  /// REQUIRES that it is one of protocol::codes().
  void add(std::string_view code);
  /// index: in protocol::codes().
  [[nodiscard]] std::uint64_t count(std::size_t index) const {
    return counts_.at(index).load(std::memory_order_relaxed);
  }

 private:
  std::array<std::atomic<std::uint64_t>, kMost> counts_{};
};

}  // namespace woodlouse::server
