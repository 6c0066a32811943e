#include "server/stream/input_stream.h"

#include <cassert>
#include <utility>

#include "shared/replay/format.h"
#include "shared/replay/line_writer.h"

namespace woodlouse::server {

void InputStream::begin_anew() {
  lines_.clear();
  first_ = next_ = quiet_ = 0;
  hash_.reset();
  kept_.clear();
}

void InputStream::step(const RecordedStep& step) {
  const match::StepRecord& record = step.record();
  if (record.tick != next_) {
    lines_.clear();
    first_ = next_ = record.tick;
    quiet_ = 0;
    hash_.reset();
    kept_.clear();
  }
  if (record.roster.empty() && record.inputs.empty() && hash_ == record.hash) {
    ++quiet_;
  } else {
    put_quiet();
    lines_ += step.line();
  }
  ++next_;
  hash_ = record.hash;
  if (quiet_ == replay::kMaxStepsBetweenKeyframes) put_quiet();
}

void InputStream::put_quiet() {
  if (quiet_ == 0) return;
  replay::append_quiet_steps(lines_, next_ - quiet_, quiet_, *hash_);
  quiet_ = 0;
}

std::optional<StreamPart> InputStream::take(Quiet quiet) {
  if (quiet == Quiet::kTold) put_quiet();
  if (lines_.empty()) return std::nullopt;
  StreamPart part{StreamPart::Kind::kSteps, first_, next_ - quiet_, {}};
  part.lines = pool_.line([this](std::string& text) { text += lines_; });
  lines_.clear();
  first_ = part.next;
  assert(part.first < part.next && part.next <= next_);
  keep(part);
  return part;
}

void InputStream::keep(const StreamPart& part) {
  if (kept_.empty()) return;
  assert(kept_.back().next == part.first);
  if (part.next > kept_until_) return kept_.clear();
  kept_.push_back(part);
}

void InputStream::keyframe(match::MatchState state, std::uint64_t kept_ticks) {
  assert(lines_.empty() && quiet_ == 0 && state.roster.empty());
  state.waiting.clear();
  std::string text;
  replay::append_keyframe(text, state);
  kept_ = {{StreamPart::Kind::kKeyframe, state.tick, state.tick, Line(std::move(text))}};
  kept_until_ = state.tick + kept_ticks;
  first_ = next_ = state.tick;
  hash_ = state.hash;
}

std::vector<StreamPart> InputStream::newest() const {
  assert(!kept_.empty() && kept_.front().kind == StreamPart::Kind::kKeyframe);
  return kept_;
}

}  // namespace woodlouse::server
