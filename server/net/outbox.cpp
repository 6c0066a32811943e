#include "server/net/outbox.h"

#include <utility>

namespace woodlouse::server {

Outbox::Push Outbox::push(Line line) {
  if (closed_) return Push::kQueued;
  if (bytes() + line->size() > limit_) return Push::kOverflow;
  waiting_bytes_ += line->size();
  lines_.push_back(std::move(line));
  return Push::kQueued;
}

void Outbox::push_last(Line line, Replaceable replaceable) {
  last_ = std::move(line);
  closed_ = true;
  if (replaceable == Replaceable::kSent) return;
  map_.reset();
  frames_.clear();
  stream_.begin_anew();
}

Outbox::PushMap Outbox::push_map(Line line) {
  if (map_) return PushMap::kAlreadyWaiting;
  if (!closed_) map_ = std::move(line);
  return PushMap::kQueued;
}

void Outbox::begin_anew() {
  map_.reset();
  frames_ = FrameSlots();
  stream_.begin_anew();
}

FrameSlots::Outcome Outbox::offer(Frame frame) {
  return closed_ ? FrameSlots::Outcome::kStale : frames_.put(std::move(frame));
}

Outbox::Batch Outbox::take(Batch written) {
  Batch batch = std::move(written);
  batch.lines.clear();
  batch.frames = 0;
  std::swap(batch.lines, lines_);
  if (map_) batch.lines.push_back(std::exchange(map_, {}));
  while (auto frame = frames_.take()) {
    batch.lines.push_back(std::move(frame->text));
    ++batch.frames;
  }
  stream_.take(batch.lines);
  if (last_) batch.lines.push_back(std::exchange(last_, {}));
  flying_bytes_ = std::exchange(waiting_bytes_, 0);
  return batch;
}

void Outbox::written() { flying_bytes_ = 0; }

}  // namespace woodlouse::server
