// Turns a running match into the bytes of a recording; writes no file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "shared/replay/format.h"
#include "shared/replay/index.h"
#include "shared/replay/line_writer.h"
#include "shared/replay/zstd_packer.h"

namespace woodlouse::replay {

enum class Encoding {
  kPlain,  ///< the text itself
  kZstd,   ///< zstd frames, one from keyframe to keyframe
};

/// By name: FILE.zst is kZstd.
Encoding encoding_of(std::string_view file);

/// How many ticks lie between keyframes. A keyframe is due at every multiple.
constexpr std::uint64_t keyframe_ticks(std::uint32_t tick_hz) {
  return std::uint64_t{kKeyframeSeconds} * tick_hz;
}

/// One writer a recording: a header, a keyframe, then steps, chats and keyframes as they happen, at last the
/// end. Every append_ adds the bytes that are ready to `out`; of kZstd some stay behind until flush().
/// Not thread safe: one thread at a time, in the order things happened.
class ReplayWriter {
 public:
  explicit ReplayWriter(Encoding encoding = Encoding::kPlain);

  void append_header(std::string& out, const Header& header);
  /// REQUIRES that state.tick is where the steps so far led, and that state.roster is empty.
  void append_keyframe(std::string& out, const match::MatchState& state);

  /// How long before its step an input came [us], negative: after. Optional; before the step that applies it.
  void note_margin(match::PlayerId player, std::uint32_t seq, std::int64_t margin_us);

  /// Steps in a row that changed nothing become one line, which is written when something else is, at the
  /// latest by flush().
  void append_step(std::string& out, const match::StepRecord& step);
  /// The same of a step whose line others have use for, too. `line`: line_writer.h's, with the margins in it;
  /// not looked at where the step is_quiet().
  void append_step(std::string& out, const match::StepRecord& step, std::string_view line);
  /// Whether the step, the next one, gets no line of its own.
  [[nodiscard]] bool is_quiet(const match::StepRecord& step) const {
    return step.roster.empty() && step.inputs.empty() && step.hash == hash_;
  }
  /// False: it was left out, for there are kMaxChatsAStep since the last step (line_order.h).
  bool append_chat(std::string& out, std::uint64_t tick, match::PlayerId player, std::string_view name,
                   std::string_view text);
  void append_pause(std::string& out, const PauseLine& pause);
  /// The index and the last line. `reason`: for people ("SIGTERM", "ticks done").
  void append_end(std::string& out, std::string_view reason);

  /// Everything appended so far is in `out` afterwards.
  void flush(std::string& out);

 private:
  void put(std::string& out);  ///< line_, as it is or packed
  void put_quiet(std::string& out);
  void forget_notes(const match::StepRecord& step);

  std::unique_ptr<FramePacker> packer_;  ///< null: plain
  std::string line_;
  std::uint64_t offset_ = 0;  ///< bytes of text so far
  std::uint64_t lines_ = 0;
  std::size_t chats_ = 0;    ///< since the last step
  std::uint64_t hash_ = 0;   ///< of the step or keyframe before
  std::uint64_t quiet_ = 0;  ///< steps that are not written yet, the last ones
  Margins margins_;          ///< of inputs not yet written
  ReplayIndex index_;
};

}  // namespace woodlouse::replay
