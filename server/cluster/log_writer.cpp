#include "server/cluster/log_writer.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace woodlouse::server {

LogWriter::LogWriter(Writer writer, std::uint64_t after) : writer_(std::move(writer)), after_(after) {
  assert(!writer_.host.empty() && writer_.epoch > 0);
}

void LogWriter::add(std::string packed) {
  assert(!packed.empty());
  if (waiting() == 0) silent_since_ = Time{};
  packed.shrink_to_fit();  // a packer has room for what does not pack: six times as much would be kept
  bytes_ += packed.size();
  batches_.push_back(std::make_shared<const std::string>(std::move(packed)));
}

std::optional<LogWriter::Publish> LogWriter::next(Time now) {
  if (!is_open() || is_asking_ || sent_ == next_number()) return std::nullopt;
  if (sent_ != acked_) return std::nullopt;
  sent_at_ = now;
  if (silent_since_ == Time{}) silent_since_ = now;
  const std::uint64_t number = sent_++;
  assert(number >= first_);
  return Publish{batches_[number - first_], sequence_of(number) - 1};
}

bool LogWriter::is_to_ask(Time now) {
  if (!is_open()) return false;
  if (sent_ != acked_ && now - sent_at_ >= kAnswerWithin) is_asking_ = true;
  if (!is_asking_ || (asked_at_ != Time::min() && now - asked_at_ < kAskEvery)) return false;
  asked_at_ = now;
  return true;
}

/// Of an old publish, too: what is stored is stored.
void LogWriter::acknowledged(std::uint64_t sequence, Time now) {
  if (!is_open() || sequence <= after_) return;
  const std::uint64_t stored = std::min(sequence - after_, next_number());
  if (stored <= acked_) return;
  acked_ = stored;
  sent_ = std::max(sent_, acked_);
  state_ = State::kWriting;
  sent_at_ = silent_since_ = now;
  while (acked_ - first_ > kMostKept || (bytes_ > kMostBytes && acked_ > first_)) {
    bytes_ -= batches_.front()->size();
    batches_.pop_front();
    ++first_;
  }
}

void LogWriter::read(const std::optional<LastBatch>& last, Time now) {
  if (!is_open() || !last) return;
  if (last->head.writer == writer_) {
    if (last->sequence != sequence_of(last->head.number)) return end(State::kGone, {});  // not of this stream
    return go_on_from(last->head.number + 1, now);
  }
  if (last->sequence <= after_) {
    // An old read, or a stream that has gone back: who is told the same again and again, though each publish
    // is refused, knows which.
    told_before_ = std::exchange(before_, last->sequence) == last->sequence ? told_before_ + 1 : 1;
    const bool has_gone_back = last->sequence < after_ || first_ != 0;
    if (has_gone_back && told_before_ >= kBelievedAfter) return end(State::kGone, {});
    return first_ == 0 ? go_on_from(0, now) : void();
  }
  // What an older writer sent long ago, and a stream that had gone back took: it owns nothing.
  if (state_ == State::kWriting && last->head.writer.epoch < writer_.epoch) return end(State::kGone, {});
  end(state_ == State::kTaking ? State::kLost : State::kFenced, last->head.writer);
}

/// All below `number` are stored; or, where that is less than was acknowledged, the stream may have gone
/// back: what is kept goes again, and is refused if it has not.
void LogWriter::go_on_from(std::uint64_t number, Time now) {
  if (number < first_) return end(State::kGone, {});
  if (number > next_number()) return end(State::kGone, {});  // nobody but this one writes in its name
  is_asking_ = false;
  if (number > acked_) acknowledged(sequence_of(number) - 1, now);
  acked_ = sent_ = number;
  sent_at_ = now;
}

void LogWriter::end(State state, const Writer& other) {
  assert(is_open());
  state_ = state;
  other_ = other;
}

}  // namespace woodlouse::server
