#include "client/watch/recording_proof.h"

#include <iterator>

#include "shared/core/stable_hash.h"

namespace woodlouse::client {

std::string to_text(const TickDifference& difference) {
  return "state DIFFERS at tick " + std::to_string(difference.tick) + ": " +
         core::to_hex(difference.recorded) + " recorded, " + core::to_hex(difference.rerun) + " re-run";
}

void RecordingProof::take(const replay::PlayedStep& step) {
  const std::uint64_t tick = step.recorded.step.tick + 1;
  if (!step.is_proven()) {
    if (!difference_ || tick < difference_->tick)
      difference_ = TickDifference{tick, step.recorded.step.hash, step.hash};
    return;
  }
  hash_ = step.hash;
  if (tick <= first_ || tick > last_) return;
  auto after = proven_.upper_bound(tick);
  const auto before = after == proven_.begin() ? proven_.end() : std::prev(after);
  if (before != proven_.end() && tick < before->second) return;
  ++count_;
  const bool joins_next = after != proven_.end() && after->first == tick + 1;
  const std::uint64_t end = joins_next ? after->second : tick + 1;
  if (joins_next) proven_.erase(after);
  if (before != proven_.end() && before->second == tick) {
    before->second = end;
  } else {
    proven_[tick] = end;
  }
}

}  // namespace woodlouse::client
