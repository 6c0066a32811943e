// King of the hill: who is alone on the place holds it, and who has held it long enough first wins the round.
// Lice bump into each other, and where the edges let them they fall.
//
// The place that counts is the next of the mode's list every move_s, told 5 s before. Who has fallen comes
// back after out_s, at the spawn that is the farthest from all lice (of equal ones the first), and who bumped
// it within the last 3 s has held 3 s more. Lice that fly hold nothing and bump into nobody. A round lasts at
// most 15 minutes, or three times what wins it; then who has held longest has won.
//
// After the world's step: who fell goes; then bumps (bump.h), pair by pair in the order of ids; then who
// comes back does; then the place moves, and who is on it holds it. Bumps, falls and returns are of every
// phase, the rest of play alone.
//
// Longest first; of equal ones who had it first, then by id.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/rules/bump.h"
#include "shared/rules/crowd.h"
#include "shared/rules/gate.h"
#include "shared/rules/players.h"
#include "shared/rules/rules.h"

namespace woodlouse::rules {

class Hill final : public Rules {
 public:
  /// REQUIRES a map with that mode, which outlives it; where lice fall, the world's edges are open
  /// (map::make_world).
  Hill(const map::Map& map, std::uint32_t tick_hz);

  [[nodiscard]] bool is_out(state::LouseId louse) const override;
  /// score: how long it has held [ticks].
  [[nodiscard]] Standing standing(state::LouseId louse) const override;
  [[nodiscard]] std::vector<TableRow> table() const override;

  [[nodiscard]] std::optional<ShownHill> shown_hill() const override {
    return ShownHill{place_, holder_, is_contested_, next_move()};
  }

  /// Which of the mode's places counts.
  [[nodiscard]] std::uint32_t place() const { return place_; }
  /// Who holds it; 0: nobody.
  [[nodiscard]] state::LouseId holder() const { return holder_; }
  /// Several are on it.
  [[nodiscard]] bool is_contested() const { return is_contested_; }
  /// The tick from which the next place counts; 0: there is no other, or it is not play.
  [[nodiscard]] std::uint64_t next_move() const;
  /// What wins a round [ticks].
  [[nodiscard]] std::uint64_t winning() const { return ticks_of(mode_.hold_s); }

 private:
  struct Player {
    state::LouseId id = 0;
    std::uint64_t held = 0;        ///< [ticks]
    std::uint64_t gained = 0;      ///< the tick at which that was reached
    state::LouseId bumped_by = 0;  ///< last; 0: nobody
    std::uint64_t bumped_at = 0;   ///< [tick]
    std::uint64_t out = 0;         ///< the tick at which it comes back; 0: it is on the map
    double distance = 0.0;         ///< of who is out, as state::Louse has it [m]
  };
  /// A louse on the ground, while a step's bumps are made.
  struct Bumper {
    std::uint32_t index = 0;   ///< in the world's lice
    Player* player = nullptr;  ///< null: nobody's
    Body body;
    bool knows_ground = false;
    bool is_bumped = false;
  };

  void on_join(state::LouseId louse) override;
  void on_leave(state::LouseId louse) override;
  void on_respawn(state::LouseId louse) override;
  void on_round(Step& step) override;
  void judge(Step& step) override;
  void write(StateWriter& out) const override;
  bool read(StateReader& in, std::span<const state::LouseId> ids) override;

  void take_fallen(Step& step);
  void fall(Player& player, double distance, std::uint64_t now);
  void bump_all(Step& step);
  void meet(const Crowd::Pair& pair, double push, std::uint64_t now);
  void note_bump(Player& first, Player& second, double impulse, std::uint64_t now);
  void tell_bump(const Event& bump);
  void bring_back(Step& step);
  [[nodiscard]] const map::SpawnPoint& farthest_spawn(const physics::World& world) const;
  void move_place(std::uint64_t now);
  void tell_move(std::uint64_t now);
  void hold(Step& step);
  void gain(Player& player, std::uint64_t ticks, std::uint64_t now);

  const map::HillMode& mode_;
  Images images_;
  std::optional<Crowd> crowd_;  ///< of maps where lice bump
  std::uint32_t place_ = 0;
  std::uint64_t next_move_ = 0;  ///< [tick]
  state::LouseId holder_ = 0;
  bool is_contested_ = false;
  Players<Player> players_;
  // Of the step that is judged.
  std::vector<Bumper> bumpers_;
  std::vector<core::Vec2> places_;  ///< of each
  std::vector<Event> bumps_;        ///< the hardest, hardest first
};

}  // namespace woodlouse::rules
