#include "server/net/frame_slots.h"

#include <utility>

namespace woodlouse::server {

FrameSlots::Outcome FrameSlots::put(Frame frame) {
  // The newest key may come again, in answer to resync, though deltas on it were seen since.
  const bool is_key = frame.kind == FrameKind::kKey;
  if (is_key ? newest_key_ && frame.tick < *newest_key_ : newest_ && frame.tick <= *newest_)
    return Outcome::kStale;
  if (is_key && newest_key_ == frame.tick) newest_.reset();  // and so may the newest delta
  if (is_key) newest_key_ = frame.tick;
  if (delta_ && (!newest_ || delta_->tick > *newest_)) newest_ = delta_->tick;
  if (!newest_ || frame.tick > *newest_) newest_ = frame.tick;

  const bool loses = is_key ? (key_ || delta_) : delta_.has_value();
  if (is_key) {
    // A waiting delta survives only a repetition of the key it rests on.
    if (delta_ && delta_->base != frame.tick) delta_.reset();
    key_ = std::move(frame);
  } else {
    delta_ = std::move(frame);
  }
  return loses ? Outcome::kReplaced : Outcome::kStored;
}

std::optional<Frame> FrameSlots::take() {
  if (key_) return std::exchange(key_, std::nullopt);
  return std::exchange(delta_, std::nullopt);
}

}  // namespace woodlouse::server
