// The race: as fast as one can through all gates, lap after lap; nobody is in anybody's way.
//
// The clock of a lap starts when its louse drives through the first gate, and a run is as many laps as the
// mode says; who drives on drives the next run. A respawn at a spawn costs nothing but the run; one at the
// last gate is practice: its run counts nowhere. Best of the round first; ties by who was first, then by id.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/rules/gate.h"
#include "shared/rules/players.h"
#include "shared/rules/rules.h"

namespace woodlouse::rules {

class Race final : public Rules {
 public:
  /// REQUIRES a map with that mode, which outlives it.
  Race(const map::Map& map, std::uint32_t tick_hz);
  /// play: how long a round is [ticks], whatever the mode says.
  Race(const map::Map& map, std::uint32_t tick_hz, std::uint64_t play);

  void before_step(const physics::World& world) override;
  [[nodiscard]] std::span<const map::SpawnPoint> spawns() const override;
  [[nodiscard]] std::optional<Start> last_gate(state::LouseId louse) const override;
  [[nodiscard]] Standing standing(state::LouseId louse) const override;
  [[nodiscard]] std::vector<TableRow> table() const override;

 private:
  struct Player {
    state::LouseId id = 0;
    std::uint32_t next = 0;  ///< the gate that counts
    // No part of the state: as long as it is within the root of `clear2` [m^2] of where it was looked at, it
    // is on the same side of that gate's line. With the above all that most ticks ask for.
    core::Vec2 looked_at;
    double clear2 = 0.0;
    std::uint32_t lap = 0;       ///< of the run, from 0
    bool is_running = false;     ///< the clock runs
    bool is_at_spawn = true;     ///< has driven through no gate since it was at rest on a spawn
    bool is_from_spawn = false;  ///< the run began so
    bool is_practice = false;    ///< the run began at a gate, or went on there
    bool has_gate = false;       ///< gate_start is one
    Moment lap_start = 0, run_start = 0;
    Moment best_lap = 0, best_run = 0;  ///< spans; 0: none
    Moment best_run_at = 0;             ///< when that run ended
    Start gate_start;                   ///< after the step that led through the last gate, on the ground
    // Of each gate, in the lap [moments]: of this lap, of the best. Elsewhere, so that what most ticks ask
    // for lies close together.
    std::vector<Moment> splits, best_splits;
  };

  [[nodiscard]] Player new_player(state::LouseId louse) const;
  void on_join(state::LouseId louse) override;
  void on_leave(state::LouseId louse) override;
  void on_respawn(state::LouseId louse) override;
  void on_respawn_at_gate(state::LouseId louse) override;
  void on_round(Step& step) override;
  void judge(Step& step) override;
  void write(StateWriter& out) const override;
  bool read(StateReader& in, std::span<const state::LouseId> ids) override;

  [[nodiscard]] map::Gate shown_from(core::Vec2 place, const map::Gate& gate) const;
  void look(Player& player, const Start& start, const state::Louse& louse, const Step& step, bool is_smooth);
  void drive(Player& player, const Start& start, const state::Louse& louse, Way way, std::uint64_t tick);
  void pass(Player& player, Moment moment);
  void end_lap(Player& player, Moment moment);
  void stop_clock(Player& player);
  [[nodiscard]] std::uint32_t rank(state::LouseId louse, Moment run, Moment at) const;
  [[nodiscard]] std::int64_t score(const Player& player) const;

  const map::RaceMode& mode_;
  Images images_;
  Players<Player> players_;
  std::vector<Start> starts_;  ///< of the world's lice, before the step
};

}  // namespace woodlouse::rules
