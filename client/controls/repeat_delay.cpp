#include "client/controls/repeat_delay.h"

#include <algorithm>
#include <cassert>

namespace woodlouse::client {

void RepeatDelay::observe(const Key& key, core::Time now) {
  assert(key.action != KeyAction::kRelease);
  assert(!key_ || now >= last_);
  const auto gap = now - last_;
  last_ = now;
  if (!key_ || key_->code != key.code || key_->character != key.character) {
    key_ = key;
    delay_.reset();
    return;
  }
  if (gap > kSlowestRepeat) {
    delay_ = gap;
    repeats_ = 0;
  } else if (delay_ && ++repeats_ == kRepeats) {
    const auto learnt = std::chrono::ceil<std::chrono::milliseconds>(*delay_) + kMargin;
    if (learnt <= kLongestPulse) pulse_ = std::max(kShortestPulse, learnt);  // else it was another press
  }
}

}  // namespace woodlouse::client
