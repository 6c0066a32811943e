// A recording opened to be looked at anywhere: what was played, who and when, and the exact match at any
// tick. The one door to recordings for whoever shows, inspects, forks or checks them.
//
//     auto archive = ReplayArchive::open(source_of_file("game.ndjson.zst"));  // plain or zstd, finished or
//     cut off auto playback = (*archive)->play((*archive)->first_tick());  // the match, restored and re-run
//     while (auto step = (*playback)->advance(); step && *step) ...
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/match/match.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/format.h"
#include "shared/replay/index.h"
#include "shared/replay/playback.h"
#include "shared/replay/source.h"

namespace woodlouse::replay {

/// Immutable once open; may be shared between threads. Each Playback reads through a stream of its own and
/// holds on to the archive.
class ReplayArchive : public std::enable_shared_from_this<ReplayArchive> {
 public:
  /// Reads header, map and index; an index that is missing, damaged, or wrong of the recording's first or
  /// last tick is made anew by scanning the file. Errors: no recording, another version or behavior (both are
  /// named), a map that is not the recorded one.
  static core::Expected<std::shared_ptr<const ReplayArchive>> open(ReplaySource source);

  [[nodiscard]] const Header& header() const { return header_; }
  [[nodiscard]] const std::shared_ptr<const map::Map>& map() const { return map_; }
  /// The tick of the first keyframe: 0, or where a fork began.
  [[nodiscard]] std::uint64_t first_tick() const { return index_.keyframes.front().tick; }
  /// The last tick that is recorded; >= first_tick().
  [[nodiscard]] std::uint64_t last_tick() const { return index_.last_tick; }
  /// [s] since tick 0.
  [[nodiscard]] double seconds_at(std::uint64_t tick) const {
    return static_cast<double>(tick) / static_cast<double>(header_.tick_hz);
  }
  /// The server did not finish it: it has no end line. What is there is as good as ever.
  [[nodiscard]] bool is_cut_off() const { return !index_.end; }
  /// Why it ended ("SIGTERM"); empty when cut off.
  [[nodiscard]] std::string_view end_reason() const {
    return index_.end ? std::string_view(index_.end->reason) : std::string_view();
  }
  /// Whoever played, by id, and from which tick to which; as the index says, which verify() alone compares.
  [[nodiscard]] std::span<const PlayerSpan> players() const { return index_.players; }
  /// Joins, leaves, respawns and chat, by tick; likewise.
  [[nodiscard]] std::span<const Mark> marks() const { return index_.marks; }
  [[nodiscard]] const ReplayIndex& index() const { return index_; }
  [[nodiscard]] const ReplaySource& source() const { return source_; }

  /// A playback that stands at a tick of first_tick() .. last_tick(), the exact match: the keyframe before it
  /// and at most kKeyframeSeconds re-run. Inputs that waited for a later tick are those the keyframe knew.
  /// Errors: the tick is not in the recording; the file is damaged there; the index misleads.
  [[nodiscard]] core::Expected<std::unique_ptr<Playback>> play(std::uint64_t tick) const;

 private:
  ReplayArchive(ReplaySource source, Header header, std::shared_ptr<const map::Map> map, ReplayIndex index);
  [[nodiscard]] bool is_index_sound(InputStream& in) const;

  ReplaySource source_;
  Header header_;
  std::shared_ptr<const map::Map> map_;
  ReplayIndex index_;
};

}  // namespace woodlouse::replay
