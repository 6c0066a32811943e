#include "server/net/send_rate.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace code = protocol::code;

protocol::Notice as_notice(std::string_view code, std::string text) {
  return {std::string(code), std::move(text)};
}

}  // namespace

bool SendRate::wants(const Frame& frame, std::uint64_t divisor) const {
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

SendRate::Change SendRate::on_frame(Time now, bool replaced) {
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

SendRate::Change SendRate::judge(Time now) {
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

SendRate::Change SendRate::lower(Time now) {
  if (std::exchange(on_trial_, false)) restore_after_ = std::min(restore_after_ * 2, kRestoreMost);
  pace_ = pace_ == Pace::kFull ? Pace::kHalf : Pace::kKeysOnly;
  clean_since_ = now;
  return Change::kLowered;
}

std::optional<protocol::Notice> SendRate::notice(Change change) const {
  if (change == Change::kNone || change == Change::kGiveUp) return std::nullopt;
  switch (pace_) {
    case Pace::kFull:
      return as_notice(code::kRateRestored, "frames at the full rate again");
    case Pace::kHalf:
      if (change == Change::kRestored) return as_notice(code::kRateLowered, "deltas again, at half the rate");
      return as_notice(code::kRateLowered, "you read slower than frames come: half the rate from now on");
    case Pace::kKeysOnly:
      return as_notice(code::kKeysOnly, "you read very slowly: only keys from now on");
  }
  return std::nullopt;
}

}  // namespace woodlouse::server
