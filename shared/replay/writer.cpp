#include "shared/replay/writer.h"

#include <algorithm>
#include <cassert>

#include "shared/replay/line_order.h"

namespace woodlouse::replay {
namespace {

bool is_player(const match::MatchState& state, match::PlayerId player) {
  const auto at =
      std::lower_bound(state.players.begin(), state.players.end(), player,
                       [](const match::PlayerSeq& p, match::PlayerId id) { return p.player < id; });
  return at != state.players.end() && at->player == player;
}

}  // namespace

Encoding encoding_of(std::string_view file) {
  constexpr std::string_view kEnd = ".zst";
  const bool is_packed = file.size() > kEnd.size() && file.substr(file.size() - kEnd.size()) == kEnd &&
                         file[file.size() - kEnd.size() - 1] != '/';
  return is_packed ? Encoding::kZstd : Encoding::kPlain;
}

ReplayWriter::ReplayWriter(Encoding encoding)
    : packer_(encoding == Encoding::kZstd ? std::make_unique<FramePacker>() : nullptr) {}

void ReplayWriter::put(std::string& out) {
  offset_ += line_.size();
  ++lines_;
  if (packer_) {
    packer_->append(out, line_);
  } else {
    out += line_;
  }
  line_.clear();
}

void ReplayWriter::append_header(std::string& out, const Header& header) {
  replay::append_header(line_, header);
  put(out);
}

void ReplayWriter::put_quiet(std::string& out) {
  if (quiet_ == 0) return;
  append_quiet_steps(line_, index_.last_tick - quiet_, quiet_, hash_);
  quiet_ = 0;
  put(out);
}

void ReplayWriter::append_keyframe(std::string& out, const match::MatchState& state) {
  assert(state.roster.empty());
  put_quiet(out);
  hash_ = state.hash;
  // Notes of inputs that their player's leaving dropped.
  std::erase_if(margins_, [&](const auto& note) { return !is_player(state, note.first.first); });
  if (packer_) packer_->end_frame(out);
  index_.add(KeyframePlace{state.tick, offset_, lines_ + 1}, Keyframe{state});
  replay::append_keyframe(line_, state);
  put(out);
}

void ReplayWriter::note_margin(match::PlayerId player, std::uint32_t seq, std::int64_t margin_us) {
  margins_[{player, seq}] = whole_milliseconds(margin_us);
}

void ReplayWriter::append_step(std::string& out, const match::StepRecord& step) {
  std::string line;
  if (!is_quiet(step)) replay::append_step(line, step, margins_);
  append_step(out, step, line);
}

void ReplayWriter::append_step(std::string& out, const match::StepRecord& step, std::string_view line) {
  const bool is_one_more = is_quiet(step);
  if (!is_one_more) {
    assert(line.ends_with('\n'));
    put_quiet(out);
    line_ = line;
    put(out);
  }
  index_.add(StepLine{step});
  forget_notes(step);
  hash_ = step.hash;
  chats_ = 0;
  if (is_one_more && ++quiet_ == kMaxStepsBetweenKeyframes) put_quiet(out);
}

void ReplayWriter::forget_notes(const match::StepRecord& step) {
  for (const match::AppliedInput& input : step.inputs) margins_.erase({input.player, input.seq});
  for (const match::RosterChange& change : step.roster) {
    if (change.action != match::RosterAction::kLeave) continue;
    // What it had filed is dropped.
    margins_.erase(margins_.lower_bound({change.player, 0}),
                   margins_.upper_bound({change.player, UINT32_MAX}));
  }
}

bool ReplayWriter::append_chat(std::string& out, std::uint64_t tick, match::PlayerId player,
                               std::string_view name, std::string_view text) {
  if (++chats_ > kMaxChatsAStep) return false;
  put_quiet(out);
  const ChatLine line{tick, player, std::string(name), std::string(text)};
  replay::append_chat(line_, line);
  put(out);
  index_.add(line);
  return true;
}

void ReplayWriter::append_pause(std::string& out, const PauseLine& pause) {
  put_quiet(out);
  replay::append_pause(line_, pause);
  put(out);
}

void ReplayWriter::append_end(std::string& out, std::string_view reason) {
  put_quiet(out);
  if (packer_) packer_->end_frame(out);
  const End end{index_.last_tick, std::string(reason), offset_};
  append_index(line_, index_);
  put(out);
  replay::append_end(line_, end);
  put(out);
  if (packer_) packer_->finish(out);
}

void ReplayWriter::flush(std::string& out) {
  put_quiet(out);
  if (packer_) packer_->flush(out);
}

}  // namespace woodlouse::replay
