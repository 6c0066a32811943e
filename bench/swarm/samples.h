// Durations that were measured, and their percentiles.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace woodlouse::swarm {

class Samples {
 public:
  void add(std::chrono::steady_clock::duration duration) {
    milliseconds_.push_back(std::chrono::duration<float, std::milli>(duration).count());
  }
  void add(const Samples& others) {
    milliseconds_.insert(milliseconds_.end(), others.milliseconds_.begin(), others.milliseconds_.end());
  }
  /// To be called once, before at().
  void sort();
  /// The smallest that at least `share` of all do not exceed [ms], share in [0, 1]; 0 when there are none.
  [[nodiscard]] double at(double share) const;
  [[nodiscard]] std::size_t size() const { return milliseconds_.size(); }

 private:
  std::vector<float> milliseconds_;
};

}  // namespace woodlouse::swarm
