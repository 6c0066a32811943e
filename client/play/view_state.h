// What the server has shown of the room: keys and deltas merged to snapshots, and every louse drawn between
// two of them.
//
// A delta is cumulative against its key: rows of the lice that differ from it, and the ids that are gone. Any
// delta may be lost; one whose key is not here can't be used, and the server is to be asked for a new key.
// Between snapshots a louse is on the cubic Hermite curve through both positions with both velocities
// (C1: no kink where a snapshot comes). A louse that jumped (a respawn) is not drawn in flight.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "client/play/shortest_way.h"
#include "shared/core/vec2.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// What the rules of play say of a louse; what a mode has not is 0.
struct Standing {
  std::int64_t score = 0;                    ///< points; of a race the best run [moments]
  std::uint32_t gate = 0;                    ///< the next
  std::uint32_t lap = 0;                     ///< of the run, from 0
  std::int64_t lap_start = 0, best_lap = 0;  ///< [moments]; 0: none
};

/// One louse at one tick.
struct LouseSample {
  core::Vec2 position;           ///< [m]
  core::Vec2 velocity;           ///< [m/s]
  core::Vec2 heading{1.0, 0.0};  ///< unit
  double distance = 0.0;         ///< travelled [m]
  double flight_z = 0.0;         ///< height while flying [m]; 0 on the ground, as on the wire
  Standing standing;
};

struct Snapshot {
  std::uint64_t tick = 0;
  std::map<std::uint32_t, LouseSample> lice;
  std::optional<protocol::Game> game;  ///< where there are rules of play; whole
};

/// The columns a client of ours asks for.
const std::vector<protocol::Column>& wanted_columns();

/// The louse between `from` and `to`, `seconds` apart, at `fraction` of the shorter way (0..1).
LouseSample between(const LouseSample& from, const LouseSample& to, double seconds, double fraction,
                    const Ways& ways = {});

class ViewState {
 public:
  enum class Merge : std::uint8_t {
    kTaken,
    kStale,        ///< not newer than what is here: passed over
    kMissingBase,  ///< a delta without its key: ask for a resync
    kUnreadable,   ///< a wanted column is not there: a server that doesn't keep its word
  };

  static constexpr std::size_t kSnapshots = 64;        ///< the oldest are forgotten beyond
  static constexpr double kExtrapolateSeconds = 0.25;  ///< beyond the newest snapshot a louse stands still

  /// columns: of the frames to come; wanted_columns() among them, in any order. before: what the rules showed
  /// last of the same game, which holds until they show something.
  explicit ViewState(std::uint32_t tick_hz, const std::vector<protocol::Column>& columns = wanted_columns(),
                     std::optional<protocol::Game> before = std::nullopt);

  Merge merge(const protocol::Frame& frame);
  /// One that was made here; passed over where it is not newer than what is here.
  void show(Snapshot snapshot);
  /// Forgets all: a new session.
  void clear();

  /// Every louse at a (fractional) tick, by id; empty before the first key.
  [[nodiscard]] std::map<std::uint32_t, LouseSample> at(double tick, const Ways& ways = {}) const;
  /// The newest snapshot; null before the first key.
  [[nodiscard]] const Snapshot* newest() const { return snapshots_.empty() ? nullptr : &snapshots_.back(); }
  /// What the rules show, or showed last; null: nothing yet, or there are none.
  [[nodiscard]] const protocol::Game* game() const {
    const std::optional<protocol::Game>& shown = snapshots_.empty() ? before_ : snapshots_.back().game;
    return shown ? &*shown : nullptr;
  }

 private:
  double tick_hz_;
  std::size_t columns_;                       ///< of a row
  std::vector<std::size_t> places_;           ///< where in a row the wanted columns stand; empty: not all do
  std::vector<std::size_t> standing_places_;  ///< the same of protocol::kRulesColumns
  std::optional<protocol::Game> before_;
  std::optional<Snapshot> key_;
  std::deque<Snapshot> snapshots_;  ///< ascending ticks
};

}  // namespace woodlouse::client
