// What a recording holds and where: the index line at its end, or a scan where that is missing or damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/error.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/format.h"

namespace woodlouse::replay {

/// Where a keyframe's line begins.
struct KeyframePlace {
  std::uint64_t tick = 0;
  std::uint64_t offset = 0;  ///< bytes before it; of a compressed recording: before it once unpacked
  std::uint64_t line = 0;    ///< its number, from 1
  friend bool operator==(const KeyframePlace&, const KeyframePlace&) = default;
};

/// Somebody's stay.
struct PlayerSpan {
  match::PlayerId player = 0;
  match::PlayerLabel label;
  std::uint64_t joined = 0;           ///< the tick that first shows the louse
  std::optional<std::uint64_t> left;  ///< the tick that no longer shows it
  friend bool operator==(const PlayerSpan&, const PlayerSpan&) = default;
};

enum class MarkKind : std::uint8_t { kJoin, kLeave, kRespawn, kChat };
/// "join", "leave", "respawn", "chat".
std::string_view to_text(MarkKind kind);

/// Something to find again on a time line.
struct Mark {
  std::uint64_t tick = 0;  ///< the step that did it
  MarkKind kind = MarkKind::kJoin;
  match::PlayerId player = 0;
  friend bool operator==(const Mark&, const Mark&) = default;
};

struct ReplayIndex {
  static constexpr std::size_t kMaxMarks = 100'000;    ///< later ones are left out
  static constexpr std::size_t kMaxPlayers = 100'000;  ///< likewise

  std::vector<KeyframePlace> keyframes;  ///< by tick; at least one
  std::vector<PlayerSpan> players;       ///< by id
  std::vector<Mark> marks;               ///< by tick
  std::uint64_t inputs = 0;              ///< applied in the whole recording
  std::uint64_t last_tick = 0;
  std::optional<End> end;  ///< empty: cut off

  /// The last keyframe at or before `tick`. REQUIRES tick >= the first one's.
  [[nodiscard]] std::size_t keyframe_before(std::uint64_t tick) const;

  // While the recording is written or scanned, in its order:
  void add(const KeyframePlace& place, const Keyframe& keyframe);
  void add(const StepLine& line);
  void add(const ChatLine& line);

  /// Null: no such player.
  [[nodiscard]] const PlayerSpan* find(match::PlayerId player) const;

 private:
  void add_player(PlayerSpan player);
  void add_mark(const Mark& mark);
};

/// What a recorded index says that the lines it stands behind do not; empty: nothing. `lines`: made of all of
/// them by add().
std::string unlike_index(const ReplayIndex& recorded, const ReplayIndex& lines);

/// The index line, newline included (index_text.cpp).
void append_index(std::string& out, const ReplayIndex& index);

/// The index of such a line. Errors: fields that are wrong or out of order. `line`: its number.
core::Expected<ReplayIndex> parse_index(const std::string& text, const std::string& source, std::size_t line);
/// The index that stands at the end of the recording; nothing where it is missing, cut off or damaged.
std::optional<ReplayIndex> read_index(InputStream& in, const std::string& source);
/// The index made anew by reading the whole recording. Errors: a damaged line; not one whole keyframe.
core::Expected<ReplayIndex> scan_index(InputStream& in, const std::string& source);

}  // namespace woodlouse::replay
