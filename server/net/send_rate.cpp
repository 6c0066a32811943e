#include "server/net/send_rate.h"

#include <algorithm>
#include <utility>

namespace woodlouse::server {

bool PaceKeeper::wants(const Frame& frame, std::uint64_t divisor) const {
  if (frame.kind == FrameKind::kKey) return true;
  switch (pace_) {
    case Pace::kFull:
      return frame.index % divisor == 0;
    case Pace::kHalf:
      return frame.index % (2 * divisor) == 0;
    case Pace::kKeysOnly:
      return false;
  }
  return false;
}

PaceKeeper::Change PaceKeeper::on_frame(Time now, bool replaced) {
  ++offered_;
  if (replaced) {
    ++replaced_;
    clean_since_ = now;
  }
  const Duration length = pace_ == Pace::kKeysOnly ? kLastWindow : kWindow;
  if (now - window_ < length) return Change::kNone;
  const Change change = judge(now);
  window_ = now;
  offered_ = replaced_ = 0;
  return change;
}

PaceKeeper::Change PaceKeeper::judge(Time now) {
  if (pace_ == Pace::kKeysOnly) {
    if (replaced_ == offered_) return Change::kGiveUp;
  } else if (replaced_ * 3 >= offered_) {
    return lower(now);
  }
  if (pace_ == Pace::kFull) {
    if (now - clean_since_ >= kRestoreMost) restore_after_ = kRestoreAfter;
    return Change::kNone;
  }
  if (now - clean_since_ < restore_after_) return Change::kNone;
  pace_ = pace_ == Pace::kKeysOnly ? Pace::kHalf : Pace::kFull;
  clean_since_ = now;
  on_trial_ = true;
  return Change::kRestored;
}

PaceKeeper::Change PaceKeeper::lower(Time now) {
  if (std::exchange(on_trial_, false)) restore_after_ = std::min(restore_after_ * 2, kRestoreMost);
  pace_ = pace_ == Pace::kFull ? Pace::kHalf : Pace::kKeysOnly;
  clean_since_ = now;
  return Change::kLowered;
}

}  // namespace woodlouse::server
