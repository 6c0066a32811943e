#include "server/stream/stream_queue.h"

#include <cassert>
#include <utility>

namespace woodlouse::server {

void StreamQueue::put(StreamPart part) {
  assert(part.lines && part.first <= part.next);
  const std::size_t size = part.lines->size();
  if (part.kind == StreamPart::Kind::kSteps) {
    if (!due_ || part.first < *due_) return;
    if (part.first > *due_ || bytes_ + size > limit_) return fall_behind();
  } else {
    waiting_.clear();
    bytes_ = 0;
    wishes_ = false;
    due_.reset();
  }
  if (part.kind == StreamPart::Kind::kHeader) {
    header_ = std::move(part.lines);
    return;
  }
  due_ = part.next;
  bytes_ += part.kind == StreamPart::Kind::kSteps ? size : 0;
  waiting_.push_back(std::move(part.lines));
}

void StreamQueue::fall_behind() {
  waiting_.clear();
  bytes_ = 0;
  due_.reset();
  wishes_ = true;
}

void StreamQueue::take(std::vector<Line>& lines) {
  if (header_) lines.push_back(std::exchange(header_, {}));
  for (Line& line : waiting_) lines.push_back(std::move(line));
  waiting_.clear();
  bytes_ = 0;
}

bool StreamQueue::take_wish() { return std::exchange(wishes_, false); }

}  // namespace woodlouse::server
