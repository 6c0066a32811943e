// A recording: one JSON object a line, written while the game runs, read by less, jq and the replayer.
//
//     {"format":"woodlouse-replay","version":1,"behavior":..,"build":..,"seed":"..","tick_hz":..,"map":{..}}
//     {"step":n,"roster":[..],"inputs":[..],"hash":"16 hex digits"}   step n -> n+1; the hash is tick n+1's
//     {"keyframe":n,"lice":[..]}                                      the exact state at tick n
//     {"chat":n,"id":..,"name":..,"text":..}                          for who reads; a re-run passes it over
//     {"end":n,"reason":".."}                                         the last tick
//
// Every step has its line, so a file that was cut off (SIGKILL) is good up to its last whole line.
// `roster` and `inputs` are left out where nothing happened. Field by field in docs/determinism.md.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/physics/louse.h"
#include "shared/protocol/messages.h"

namespace woodlouse::replay {

inline constexpr std::string_view kFormat = "woodlouse-replay";
inline constexpr int kFormatVersion = 1;
inline constexpr std::size_t kMaxInlineMapBytes = 1u << 20;  ///< a longer map is named by hash and file
inline constexpr std::size_t kMaxReplayLineBytes = 32u << 20;
inline constexpr std::uint32_t kKeyframeSeconds = 5;

/// The first line: what was played, by which rules.
struct Header {
  int behavior = match::kBehavior;
  std::string build;  ///< name and version of the server, for people
  std::uint64_t seed = 0;
  std::uint32_t tick_hz = 60;
  std::string map_name;
  std::uint64_t map_hash = 0;
  std::string map_definition;  ///< the canonical map; empty where it is longer than kMaxInlineMapBytes
  std::string map_file;        ///< where the server found it; only used when map_definition is empty
};

/// The header of a match. `map_file` as the server was given it.
Header make_header(const match::Match& match, std::string_view build, std::string_view map_file);

struct PlayerLabel {
  std::string name;
  protocol::Role role = protocol::Role::kPlayer;
};

/// Turns a running match into lines; appends them to a string, writes no file. One writer a recording.
/// Not thread safe: one thread at a time, in the order things happened.
class ReplayWriter {
 public:
  /// keyframe_ticks: a keyframe at every multiple of it; usually kKeyframeSeconds * tick_hz. REQUIRES > 0.
  explicit ReplayWriter(std::uint32_t keyframe_ticks) : keyframe_ticks_(keyframe_ticks) {
    assert(keyframe_ticks > 0);
  }

  void append_header(std::string& out, const Header& header) const;

  /// Labels a player's join. Call it before the step that applies the join; without it the join has no name.
  void note_player(match::PlayerId player, std::string_view name, protocol::Role role);
  /// How long before its step an input came [us]. Optional; call it when the input was filed.
  void note_margin(match::PlayerId player, std::uint32_t seq, std::int64_t margin_us);

  /// The step's line and, where one is due, the keyframe after it. `lice`: the world after the step.
  void append_step(std::string& out, const match::StepRecord& step, std::span<const physics::Louse> lice);
  void append_chat(std::string& out, std::uint64_t tick, match::PlayerId player, std::string_view name,
                   std::string_view text) const;
  /// The last line. `tick`: the match's tick when it ended; `reason`: for people ("SIGTERM", "ticks done").
  void append_end(std::string& out, std::uint64_t tick, std::string_view reason) const;

 private:
  void append_roster(std::string& out, std::span<const match::RosterChange> roster);
  void append_inputs(std::string& out, std::span<const match::AppliedInput> inputs);

  std::uint32_t keyframe_ticks_;
  std::map<match::PlayerId, PlayerLabel> labels_;                              ///< of joins not yet written
  std::map<std::pair<match::PlayerId, std::uint32_t>, std::int64_t> margins_;  ///< of inputs not yet written
};

/// A step's line. The labels and margins stand in the order of step.roster and step.inputs.
struct StepLine {
  match::StepRecord step;
  std::vector<std::optional<PlayerLabel>> labels;
  std::vector<std::optional<std::int64_t>> margins_us;
};
struct Keyframe {
  std::uint64_t tick = 0;
  std::vector<physics::Louse> lice;
};
struct ChatLine {
  std::uint64_t tick = 0;
  match::PlayerId player = 0;
  std::string name, text;
};
struct End {
  std::uint64_t tick = 0;
  std::string reason;
};
using Line = std::variant<StepLine, Keyframe, ChatLine, End>;

/// Reads a recording line by line; memory is bounded by one line. Every field is checked here: what passes is
/// in range, so that a re-run may trust it (but not that steps follow each other: that is the replayer's).
class ReplayReader {
 public:
  /// `in` outlives the reader; `source` names it in errors ("FILE:LINE: field: what").
  ReplayReader(std::istream& in, std::string source) : in_(in), source_(std::move(source)) {}

  /// The first line. Refuses another format, version or behavior, naming both.
  core::Expected<Header> read_header();
  /// The next line; nothing at the end of the file, or after a last line that was cut off.
  core::Expected<std::optional<Line>> next();

  /// The file's last line has no newline: whoever wrote it was interrupted. Known once next() gave nothing.
  [[nodiscard]] bool is_cut_off() const { return cut_off_; }
  /// The line read last, from 1.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  core::Expected<bool> read_line();  ///< false: no further whole line

  std::istream& in_;
  std::string source_;
  std::string line_;
  std::size_t line_number_ = 0;
  bool cut_off_ = false;
};

}  // namespace woodlouse::replay
