// The rules of play: what lice do to a score. They see both ends of each step and what the world says
// happened in it, judge, and may move lice: after the step, before the hash. Their whole state is integers
// (and doubles' bits that came from a louse), so that it is hashed, kept in keyframes and gone on from like
// the lice.
//
// Who calls: match::Match, in the order of a tick: respawn / join / leave as the roster changes, before_step,
// the world's step, after_step. Same calls, same bits.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/map/map_definition.h"
#include "shared/physics/world.h"
#include "shared/rules/event.h"
#include "shared/rules/round.h"
#include "shared/rules/state_bytes.h"
#include "shared/state/louse.h"
#include "shared/state/mode.h"

namespace woodlouse::rules {

/// A louse's standing, for columns of the wire; what a mode has not is 0.
struct Standing {
  std::int64_t score = 0;
  std::uint32_t gate = 0;  ///< the next
  std::uint32_t lap = 0;
  Moment lap_start = 0;  ///< 0: its clock does not run
  Moment best_lap = 0;   ///< as a span; 0: none
  friend bool operator==(const Standing&, const Standing&) = default;
};

/// A row of the table, best first. score: points; in a race the best run as a span of moments, 0: none.
struct TableRow {
  state::LouseId louse = 0;
  std::int64_t score = 0;
  friend bool operator==(const TableRow&, const TableRow&) = default;
};

/// A crumb that lies somewhere, or did.
struct ShownCrumb {
  std::uint32_t slot = 0;
  core::Vec2 position;      ///< [m]
  std::uint32_t value = 0;  ///< 0: eaten
  friend bool operator==(const ShownCrumb&, const ShownCrumb&) = default;
};

/// The place that is held.
struct ShownHill {
  std::uint32_t place = 0;    ///< of the mode's places
  state::LouseId holder = 0;  ///< 0: nobody
  bool is_contested = false;
  std::uint64_t moves_at = 0;  ///< the tick from which on the next place counts
  friend bool operator==(const ShownHill&, const ShownHill&) = default;
};

/// A louse at the start of a step, or where it is to go on.
struct Start {
  core::Vec2 position, velocity;
  bool is_flying = false;
};

class Rules {
 public:
  virtual ~Rules() = default;

  /// Those of a map's mode; null: there are none (roam). REQUIRES map.definition.modes.has(mode) and a map
  /// that outlives them.
  static std::unique_ptr<Rules> make(state::Mode mode, const map::Map& map, std::uint32_t tick_hz);

  // What the roster does. An id joins once. Of one that does not play (a keyframe from outside may have such
  // a louse) nothing is taken.

  void join(state::LouseId louse);
  void leave(state::LouseId louse);
  /// Goes back to a spawn, by its own wish.
  void respawn(state::LouseId louse);
  /// Goes back to last_gate(), which there is.
  void respawn_at_gate(state::LouseId louse);
  /// Of a louse that plays but has nothing on the map at present: out, it will be back.
  [[nodiscard]] virtual bool is_out(state::LouseId) const { return false; }
  /// Where lice begin; at least one.
  [[nodiscard]] virtual std::span<const map::SpawnPoint> spawns() const { return map_.definition.spawns; }
  /// Where a respawn at the last gate leads; nothing: the louse has passed none.
  [[nodiscard]] virtual std::optional<Start> last_gate(state::LouseId) const { return std::nullopt; }

  // The step.

  /// Keeps what the mode will judge by of the step's start.
  virtual void before_step(const physics::World&) {}
  /// Judges the step from `tick`, which the world has made. `hash`: of the match at that tick, what draws are
  /// made from. REQUIRES that lice are neither more nor fewer than before the step.
  void after_step(physics::World& world, std::uint64_t tick, std::uint64_t hash);
  /// Of the last step, by (louse, moment) and, where these are equal, in the order they happened.
  [[nodiscard]] std::span<const Event> events() const { return events_; }

  // What is seen from outside, between steps.

  [[nodiscard]] const Round& round() const { return round_; }
  /// Nothing will happen until somebody joins.
  [[nodiscard]] bool stands_still() const { return round_.phase == Phase::kGather; }
  [[nodiscard]] virtual Standing standing(state::LouseId louse) const = 0;
  /// Of all who play, best first; ties by the mode's own rule, then by id.
  [[nodiscard]] virtual std::vector<TableRow> table() const = 0;
  /// All slots, ascending; of forage.
  [[nodiscard]] virtual std::vector<ShownCrumb> shown_crumbs() const { return {}; }
  /// Of hill.
  [[nodiscard]] virtual std::optional<ShownHill> shown_hill() const { return std::nullopt; }
  [[nodiscard]] state::Mode mode() const { return mode_; }

  /// XXH64 of the state; changes only in a step. 0, and the state empty, as long as nothing has happened.
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  [[nodiscard]] std::string state() const;
  /// Goes on from state() of the same map, mode and tick rate. False, and nothing is known of the rules any
  /// more: no rules of it have such a state. `ids`: those who play, ascending. REQUIRES fresh rules.
  [[nodiscard]] bool restore(std::string_view state, std::span<const state::LouseId> ids);

 protected:
  Rules(state::Mode mode, const map::Map& map, std::uint32_t tick_hz, const RoundLengths& lengths);

  /// What a mode judges a step by.
  struct Step {
    physics::World& world;
    std::uint64_t tick;  ///< the step's: it led to tick + 1
    std::uint64_t hash;  ///< of the match at `tick`
  };

  // A mode's own. What changes its state says so: note_change().

  virtual void on_join(state::LouseId louse) = 0;
  virtual void on_leave(state::LouseId louse) = 0;
  virtual void on_respawn(state::LouseId louse) = 0;
  virtual void on_respawn_at_gate(state::LouseId) {}
  /// A round begins: everybody at the beginning. In the step that led there.
  virtual void on_round(Step& step) = 0;
  /// In every step of every phase but gather; what counts only in play asks round().
  virtual void judge(Step& step) = 0;
  virtual void write(StateWriter& out) const = 0;
  /// False: not a state of these rules. `ids` as restore() has them.
  virtual bool read(StateReader& in, std::span<const state::LouseId> ids) = 0;

  void note_change() { has_changed_ = true; }
  void say(const Event& event) { events_.push_back(event); }
  /// The round is over before its time, at the end of this step.
  void end_round() { is_round_won_ = true; }
  [[nodiscard]] const map::Map& map() const { return map_; }
  /// The ground at a place; of one that lies outside, as a state from outside may have it, at the edge.
  [[nodiscard]] terrain::SurfaceSample ground_at(core::Vec2 place) const;
  [[nodiscard]] std::uint32_t tick_hz() const { return tick_hz_; }
  [[nodiscard]] std::uint64_t ticks_of(std::uint64_t seconds) const { return seconds * tick_hz_; }

 private:
  [[nodiscard]] bool plays(state::LouseId louse) const {
    return std::binary_search(ids_.begin(), ids_.end(), louse);
  }
  void move_clock(Step& step);
  void begin_round(Step& step);
  void play(Step& step);
  void begin_phase(Phase phase, std::uint64_t tick, std::uint64_t length);
  void write_all(StateWriter& out) const;

  state::Mode mode_;
  const map::Map& map_;
  std::uint32_t tick_hz_;
  RoundLengths lengths_;
  Round round_;
  std::vector<state::LouseId> ids_;  ///< who plays, ascending
  bool is_round_won_ = false;
  bool has_changed_ = false;
  std::vector<Event> events_;
  StateWriter bytes_;
  std::uint64_t hash_ = 0;
};

}  // namespace woodlouse::rules
