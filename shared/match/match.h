// One game without a clock, a socket or a file: joins and inputs in, ticks and their proof out.
// What a server runs live and what a replay re-runs; the same calls give the same bits.
//
// Tick n is the state before step n. advance() performs step n: leaves, joins and respawns queued since the
// last step in the order they came, then the inputs filed for n in the order (player, seq), the last of a
// player winning; then the world's step, which the rules of play judge. Arrival order of inputs never changes
// a result.
// Not thread safe: its room's strand owns it.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/random.h"
#include "shared/core/stable_hash.h"
#include "shared/core/team.h"
#include "shared/map/map_definition.h"
#include "shared/match/input_queue.h"
#include "shared/match/match_state.h"
#include "shared/physics/world.h"
#include "shared/rules/rules.h"
#include "shared/state/mode.h"

namespace woodlouse::match {

/// Changes only when the same inputs would give another result; tied to the golden hashes in tests/.
inline constexpr int kBehavior = 10;

/// How far ahead an input may ask for its tick.
inline constexpr std::uint64_t kHorizonSeconds = 2;

using PlayerId = state::LouseId;

/// A louse that began at a spawn in a step, and which of the mode's that is.
struct Spawned {
  PlayerId player = 0;
  std::uint32_t spawn = 0;
};

/// Everything one step did; with the header, all that a replay needs.
struct StepRecord {
  std::uint64_t tick = 0;            ///< n: the step led from tick n to n + 1
  std::vector<RosterChange> roster;  ///< in the order applied
  std::vector<AppliedInput> inputs;  ///< in the order applied
  std::vector<Spawned> spawned;      ///< in the order of the roster; no recording holds them
  std::vector<rules::Event> events;  ///< what the rules of play say happened; no recording holds them
  std::uint64_t hash = 0;            ///< of the state at tick n + 1; that of tick n where nothing changed
};

struct MatchSettings {
  std::uint32_t tick_hz = 60;  ///< 1..1000
  std::uint64_t seed = 0;
  state::Mode mode = state::Mode::kRoam;  ///< one that the map has
};

class Match {
 public:
  Match(std::shared_ptr<const map::Map> map, const MatchSettings& settings);
  /// The match that was in that state: every further call gives what it gave there, bit for bit.
  /// settings.seed is kept for who asks; the generator goes on from the state. REQUIRES why_not(*map,
  /// settings, state) to be empty (match_state.h).
  static std::unique_ptr<Match> restore(std::shared_ptr<const map::Map> map, const MatchSettings& settings,
                                        const MatchState& state);
  /// All of it, between two steps.
  [[nodiscard]] MatchState state() const;

  /// Chooses how many lice are stepped at once; every choice gives the same bits (physics/world.h).
  void use(physics::InstructionSet set) { world_.use(set); }
  /// Has steps and hashes of many lice made by a team; every team gives the same bits (physics/world.h).
  void use(const std::shared_ptr<core::Team>& team) {
    team_ = team;
    world_.use(team);
  }
  /// How many threads share a step of many lice.
  [[nodiscard]] std::size_t step_threads() const { return team_ == nullptr ? 1 : team_->size(); }

  /// Queues a new louse for the next step; its id is fresh and known at once. REQUIRES a role that plays.
  PlayerId join(PlayerLabel label = {});
  /// Queues a join under a given id, for replays. REQUIRES an id never used before in this match.
  void join_as(PlayerId player, PlayerLabel label = {});
  /// Queues the removal of a louse. Its filed inputs are dropped.
  void leave(PlayerId player);
  /// Queues a return to a spawn point, at rest, without thrust; the distance travelled stays.
  void respawn(PlayerId player);
  /// Queues a return to where it drove through its last gate, and as fast; where there is none, a respawn().
  void respawn_at_gate(PlayerId player);
  /// Files an input for a tick; says which tick will take it. per_tick: of one player's (input_queue.h).
  Filed file(const Input& input, std::size_t per_tick = InputQueue::kMaxPending);
  /// Nobody steers any more: where an input waits, and in `ticks`, one that ends the thrust comes behind it.
  /// The first is `seq`; gives the one after the last.
  std::uint32_t end_thrusts(PlayerId player, std::uint32_t seq, std::set<std::uint64_t> ticks) {
    return inputs_.end_thrusts(player, seq, std::move(ticks));
  }

  /// Files an input that the next step is known to have applied, for replays: no rule of filing stands in its
  /// way. False: the player has no louse. REQUIRES input.tick == tick().
  bool file_applied(const AppliedInput& input);

  /// Performs the next step. The record is valid until the next call.
  const StepRecord& advance();
  /// Whether the steps to come are known to change nothing but tick(), until somebody asks for something.
  [[nodiscard]] bool stands_still() const {
    return world_.stands_still() && pending_roster_.empty() && !inputs_.has_waiting() &&
           (rules_ == nullptr || rules_->stands_still());
  }
  /// Performs so many of them, at the cost of none. REQUIRES stands_still().
  void stand_still(std::uint64_t steps) {
    assert(stands_still());
    tick_ += steps;
  }

  /// The next step's number; the world shows the state before it.
  [[nodiscard]] std::uint64_t tick() const { return tick_; }
  [[nodiscard]] const physics::World& world() const { return world_; }
  [[nodiscard]] const map::Map& map() const { return *map_; }
  [[nodiscard]] const std::shared_ptr<const map::Map>& shared_map() const { return map_; }
  [[nodiscard]] const MatchSettings& settings() const { return settings_; }
  /// Of the state at tick(); 0 until a step has done something.
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  /// What went into hash() besides the lice; its tick is that of the last step that changed anything.
  [[nodiscard]] const state::HashLink& link() const { return link_; }
  /// The rules of play; null: there are none.
  [[nodiscard]] const rules::Rules* rules() const { return rules_.get(); }
  /// Whether it has a louse on the map; who is out for a while (rules::Rules::is_out) has not.
  [[nodiscard]] bool contains(PlayerId player) const { return world_.find(player) != nullptr; }
  /// Of everybody who joined and has not left.
  [[nodiscard]] const PlayerLabels& labels() const { return labels_; }

 private:
  void spawn(PlayerId player, double distance);
  void change(const RosterChange& change);
  void put_at_gate(PlayerId player, const rules::Start& at, double distance);
  void change_roster();
  void apply_inputs();
  void judge();
  void link_up();

  std::shared_ptr<const map::Map> map_;
  MatchSettings settings_;
  std::shared_ptr<core::Team> team_;
  physics::World world_;
  std::unique_ptr<rules::Rules> rules_;
  core::Random random_;
  InputQueue inputs_;
  std::vector<RosterChange> pending_roster_;
  PlayerLabels labels_;
  PlayerId next_player_ = 1;
  std::uint64_t tick_ = 0;
  std::uint64_t hash_ = 0;
  state::HashLink link_;
  state::BlockHashes lice_hashes_;
  core::StableHasher hasher_;
  StepRecord record_;
};

}  // namespace woodlouse::match
