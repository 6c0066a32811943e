// Many lice on one terrain, stepped by a fixed time: same inputs, same bits.
//
// A step, per louse that is not at rest (physics: docs/physics.md):
//   1. sample the surface; forces and curvature give the acceleration        surface_motion.h
//   2. choose the sub-step from the state alone                              stepper.h
//   3. Nystrom-4 over the sub-step; friction stops it, a wall bounces it     stepper.h
//   4. count down its thrust, add to its distance, put it to rest if friction holds it
// Lice do not touch each other. Forces that the map has not are compiled out (drag beside others is passed
// over); lice at rest are in no list that a step walks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/core/team.h"
#include "shared/core/vec2.h"
#include "shared/physics/batch.h"
#include "shared/physics/step_counters.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/state/state_hash.h"
#include "shared/state/step_events.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::physics {

class GroundSteps;

class World {
 public:
  /// Moving lice that a member of a team is asked for, at least: fewer than twice as many are stepped by the
  /// caller alone. Two threads that had slept, measured against one, each with the other's ticks in turns,
  /// by AVX-512 (bench/results/step-threads.txt):
  ///     lice            1000  1500  2000  2500  3000  4000  6000
  ///     times as fast   0.72  0.86  0.97  1.18  1.13  1.30  1.43
  static constexpr std::size_t kMemberLice = 1500;

  /// step: seconds per tick, > 0. Walls stand at the terrain's edge. REQUIRES the exact equations and a
  /// terrain that is no SharedSurface; a map's world: map/map_world.h.
  World(std::shared_ptr<const terrain::Terrain> terrain, const state::Parameters& parameters, double step);
  /// The same with walls elsewhere; infinite ones keep nobody (laboratory and tests).
  World(std::shared_ptr<const terrain::Terrain> terrain, const state::Parameters& parameters, double step,
        const terrain::Rectangle& walls);
  /// The same by steps made elsewhere, for those walls and parameters and that step; the terrain is only
  /// looked at.
  World(std::shared_ptr<const terrain::Terrain> terrain, const state::Parameters& parameters, double step,
        const terrain::Rectangle& walls, std::shared_ptr<const GroundSteps> steps);

  /// Chooses how many lice are stepped at once; every choice gives the same bits. REQUIRES is_available(set).
  /// The best one is chosen from the start.
  void use(InstructionSet set);
  /// Has lice stepped by a team where they are many; every team gives the same bits, and so does none (null).
  /// A copy of the world has the same team. A team that is at another world is not waited for.
  void use(std::shared_ptr<core::Team> team);

  /// Adds a louse; its position is moved into the domain where it lies outside (by whole periods where the
  /// edges wrap). REQUIRES a fresh id and finite fields. A louse at rest that the terrain or its thrust would
  /// move is woken.
  void insert(const state::Louse& louse);
  /// Replaces all lice by these, bit for bit: none is moved, woken or put to rest. REQUIRES ascending ids and
  /// a state that a step of such a world left.
  void restore(std::span<const state::Louse> lice);
  /// Removes it; false when there is none of that id.
  bool erase(state::LouseId id);
  /// Replaces its thrust for `ticks` ticks (kHeld: until the next); wakes it where that moves it.
  /// REQUIRES |value| <= 1. False when there is none of that id.
  bool set_thrust(state::LouseId id, const state::Thrust& thrust, std::uint32_t ticks);
  /// Replaces where it is over the map and how fast, as who bumps into it does; a place outside the domain is
  /// moved as insert() does. Wakes it, or puts it to rest. It looks along its velocity, unless a thrust turns
  /// its heading or it stands: then it keeps it. One that flies flies on, as high and with the same climb.
  /// REQUIRES finite vectors. False when there is none of that id.
  bool set_motion(state::LouseId id, core::Vec2 position, core::Vec2 velocity);
  /// The same of lice()[index], for who has just found it there.
  void set_motion_at(std::size_t index, core::Vec2 position, core::Vec2 velocity);
  /// Steps every louse that is not at rest.
  void step();
  /// Whether the next step is known to change nothing: no louse moves, and no thrust of one at rest runs out.
  [[nodiscard]] bool stands_still() const { return !lists_are_stale_ && moving_.empty() && waiting_.empty(); }

  /// Every louse, by ascending id.
  [[nodiscard]] std::span<const state::Louse> lice() const { return lice_; }
  /// Of each block of state::kBlockLice lice whether one of them may have changed since forget_changes(): 0
  /// where none did (state_hash.h).
  [[nodiscard]] std::span<const std::uint8_t> changed_blocks() const { return changed_blocks_; }
  void forget_changes();
  /// What happened to each louse of lice() in the last step (step_events.h); 0 of who has joined since.
  [[nodiscard]] std::span<const state::StepEvents> events() const { return events_; }
  /// The louse of that id, or null; valid until the next change.
  [[nodiscard]] const state::Louse* find(state::LouseId id) const;
  [[nodiscard]] const terrain::Terrain& terrain() const { return *terrain_; }
  [[nodiscard]] const state::Parameters& parameters() const { return parameters_; }
  [[nodiscard]] double step_seconds() const { return step_; }
  [[nodiscard]] const StepCounters& counters() const { return counters_; }

 private:
  /// Some of those who move and of those who wait, and what one thread writes in a step but for its lice and
  /// their blocks' flags. Parts meet where blocks do: no two threads write the same ones. On cache lines of
  /// its own.
  struct alignas(64) Part {
    std::size_t moving_begin = 0, moving_end = 0;    ///< places in moving_
    std::size_t waiting_begin = 0, waiting_end = 0;  ///< places in waiting_
    BatchLists lists;
    StepCounters counters;
    bool lists_are_stale = false;
  };

  [[nodiscard]] std::size_t index_of(state::LouseId id) const;
  void settle(state::Louse& louse) const;
  [[nodiscard]] core::Vec2 in_domain(core::Vec2 position) const;
  void collect();
  void cut();
  void step(Part& part);
  /// Looks first: threads whose flags lie on one cache line would take it from each other at every louse.
  void note_change(std::size_t index) {
    std::uint8_t& flag = changed_blocks_[index / state::kBlockLice];
    if (flag == 0) flag = 1;
  }
  void note_changes_from(std::size_t index);

  std::shared_ptr<const terrain::Terrain> terrain_;
  state::Parameters parameters_;
  double step_;
  terrain::Rectangle walls_;
  std::shared_ptr<const GroundSteps> ground_steps_;  ///< compiled for the terrain, the method and the forces
  std::vector<state::Louse> lice_;                   ///< ascending id
  std::vector<std::uint32_t> moving_;                ///< indices into lice_ of whom a step moves, ascending
  std::vector<std::uint32_t> waiting_;               ///< of those at rest whose thrust is to be counted down
  std::vector<Part> parts_;                          ///< of both lists; all of them, by ascending place
  bool lists_are_stale_ = false;  ///< lice_ or who is in which list changed since they were made
  std::vector<std::uint8_t> changed_blocks_;
  std::vector<state::StepEvents> events_;
  BatchStep batch_;
  std::shared_ptr<core::Team> team_;
  StepCounters counters_;
};

}  // namespace woodlouse::physics
