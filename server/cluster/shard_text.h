// A shard's log as text: what its rooms tell becomes lines, cut into batches; knows where each room's newest
// header and keyframe are. A room whose lines could not be kept begins again at its next keyframe. Pure but
// for what its rooms are told. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/claim.h"
#include "server/cluster/batch.h"
#include "server/room/tick_watcher.h"
#include "server/stream/recorded_step.h"
#include "server/timing/clock.h"
#include "shared/match/match.h"
#include "shared/replay/format.h"
#include "shared/replay/writer.h"

namespace woodlouse::server {

/// Which of the process' games a line is of: a room has several, one after the other.
using TapNumber = std::uint64_t;

class ShardText {
 public:
  /// keep: how long the stream holds a batch; each room's header and keyframe are told anew three times
  /// within it.
  explicit ShardText(Duration keep) : renew_every_(keep / 3) {}

  /// A game of a room; it is that room's from now on. One room too many is told so, and is in no log.
  /// announce: tells the room; any thread.
  void begin(TapNumber tap, const std::string& room, const replay::Header& header,
             const match::MatchState& state, TickWatcher::Announce announce, Time now);
  // Of a game that has begun; nothing where the room has another one by now:
  void claim(TapNumber tap, const Claim& claim);
  void chat(TapNumber tap, std::uint64_t tick, match::PlayerId player, const std::string& name,
            const std::string& text);
  void step(TapNumber tap, const RecordedStep& step);
  /// is_anew: lines before it are missing.
  void keyframe(TapNumber tap, const match::MatchState& state, bool is_anew, Time now);
  /// kept: called once its lines so far are stored, or are lost; at once where there are none.
  void await_kept(TapNumber tap, std::function<void()> kept);
  [[nodiscard]] bool is_awaited() const { return !awaiting_.empty(); }
  /// Who waits for the lines of the last cut.
  [[nodiscard]] std::vector<std::function<void()>> take_awaiting() { return std::exchange(awaiting_, {}); }
  /// It stands still there.
  void rest(TapNumber tap, match::MatchState state);
  void close(TapNumber tap);

  /// Rooms that stand still are told anew when it is time, till there are `most` bytes of lines: the others
  /// the next time.
  void renew(Time now, std::size_t most);
  /// All lines so far are dropped, and who waits for them waits no more; each room is told of no more until a
  /// keyframe of it comes.
  void lose();
  /// To every room, and, where it holds from now on, to each that begins.
  void announce(const protocol::Notice& notice, bool holds);

  /// What is held back of steps in which nothing happened is among the lines.
  void flush();
  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  /// Rooms that end from now on are not closed: they go on elsewhere.
  void keep_rooms() { keeps_rooms_ = true; }
  /// No batch that was told of is there any more.
  void forget_places() { places_.clear(); }
  /// The lines so far, which go into the batch of that sequence number.
  std::string cut(std::uint64_t sequence);
  /// As of the last cut; of rooms that another writer of this log has told of before, too, till they begin
  /// here.
  [[nodiscard]] std::vector<RoomPlace> places() const;
  void take_over(const std::vector<RoomPlace>& places);
  /// Others go on nowhere.
  void keep_places(const std::set<std::string>& rooms);

 private:
  struct Room {
    TapNumber tap = 0;
    std::string name;
    replay::Header header;
    replay::ReplayWriter lines;
    std::map<match::PlayerId, Claim> claims;
    TickWatcher::Announce announce;
    std::optional<match::MatchState> resting;
    std::uint64_t tick = 0;
    Time renew_at{};
    bool has_begun = false;     ///< header and keyframe are told
    bool has_header = false;    ///< in the lines so far
    bool has_keyframe = false;  ///< likewise
  };
  [[nodiscard]] Room* find(TapNumber tap);
  std::string& lines_of(const Room& room);
  void tell(Room& room, const match::MatchState& state, bool with_header, Time now);

  const Duration renew_every_;
  std::map<std::string, Room, std::less<>> rooms_;
  std::map<TapNumber, Room*> by_tap_;  ///< those whose game is the room's
  std::map<std::string, RoomPlace, std::less<>> places_;
  std::string lines_;
  std::vector<std::function<void()>> awaiting_;
  std::optional<protocol::Notice> standing_;  ///< what holds now
  bool keeps_rooms_ = false;
  const Room* last_ = nullptr;  ///< whose the last line is
};

}  // namespace woodlouse::server
