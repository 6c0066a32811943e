#include "client/watch/recording_proof.h"

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
  const std::uint64_t place = tick - first_ - 1;
  if (place >= proven_.size() || proven_[place]) return;
  proven_[place] = true;
  ++count_;
}

}  // namespace woodlouse::client
