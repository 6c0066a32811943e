// Forage: crumbs lie about, and who rolls over one eats it; those on summits are worth three.
//
// Crumbs have slots, 0 to crumbs - 1. One that was eaten comes back 3 s later, drawn by core::Random(XXH64 of
// the match's hash at the step's tick, then the slot: 8 bytes each, little-endian): nobody knows before that
// step where it will lie, and every copy of the game draws the same. Places are whole 1/1024 m.
//
// A crumb is eaten by who comes within its radius first in a step, on the chord between the step's ends; of
// several at the same 1/65536 of it by who had fewer points before the step, then by the smaller id. Who
// flies more than 1 m above the ground at the step's end eats nothing. One after the other within 4 s makes a
// chain: twice its value, then three times. Within the last 30 s of a round (of a round below 90 s: its last
// third) all of that is doubled.
//
// Most points first; of equal ones who had them first, then by id.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/core/random.h"
#include "shared/rules/crumb_map.h"
#include "shared/rules/gate.h"
#include "shared/rules/players.h"
#include "shared/rules/rules.h"

namespace woodlouse::rules {

class Forage final : public Rules {
 public:
  /// REQUIRES a map with that mode, which outlives it.
  Forage(const map::Map& map, std::uint32_t tick_hz);

  void before_step(const physics::World& world) override;
  [[nodiscard]] Standing standing(state::LouseId louse) const override;
  [[nodiscard]] std::vector<TableRow> table() const override;

  [[nodiscard]] std::vector<ShownCrumb> shown_crumbs() const override;

  [[nodiscard]] std::size_t slots() const { return slots_.size(); }
  /// REQUIRES slot < slots().
  [[nodiscard]] ShownCrumb crumb(std::uint32_t slot) const;
  /// Those that lie, by slot.
  [[nodiscard]] std::vector<ShownCrumb> crumbs() const;
  /// The slots that the last step has changed: bit 1 << slot. None after restore().
  [[nodiscard]] std::uint64_t changed() const { return changed_; }
  /// The tick from which crumbs count twice, in play; 0: they won't, or it is not play.
  [[nodiscard]] std::uint64_t harvest() const;

 private:
  struct Player {
    state::LouseId id = 0;
    std::uint8_t chain = 0;  ///< what the last crumb was multiplied by, 1..3; 0: there was none
    std::int64_t score = 0;
    Moment last = 0;  ///< when it ate last
  };
  /// In 1/1024 m.
  struct Place {
    std::int64_t x = 0, y = 0;
    friend bool operator==(const Place&, const Place&) = default;
  };
  struct Slot {
    Place place;  ///< of what lies there; else 0
    std::uint8_t value = 0;
    std::uint64_t due = 0;  ///< the tick of the next, where nothing lies; 0: there is none
  };
  /// Who eats a slot's crumb in a step.
  struct Claim {
    Player* player = nullptr;
    std::uint64_t part = 0;  ///< of the step, 0..65536
  };

  void on_join(state::LouseId louse) override;
  void on_leave(state::LouseId louse) override;
  void on_respawn(state::LouseId) override {}
  void on_round(Step& step) override;
  void judge(Step& step) override;
  void write(StateWriter& out) const override;
  bool read(StateReader& in, std::span<const state::LouseId> ids) override;

  void map_crumbs();
  void claim_all(const Step& step);
  void claim(core::Vec2 from, const state::Louse& louse, Player& player);
  void eat_claimed(const Step& step);
  void eat(std::size_t slot, Player& player, Moment moment);
  void fill(std::size_t slot, const Step& step);
  [[nodiscard]] std::vector<Place> free_summits(const physics::World& world) const;
  [[nodiscard]] Place ground_for(core::Random& random, const physics::World& world) const;
  [[nodiscard]] bool is_good(Place place, const physics::World& world) const;
  [[nodiscard]] bool has_louse_near(core::Vec2 at, const physics::World& world) const;
  [[nodiscard]] bool is_within(Place place) const;
  [[nodiscard]] core::Vec2 position(Place place) const;
  [[nodiscard]] Place place_at(core::Vec2 position) const;

  const map::ForageMode& mode_;
  Images images_;
  Place low_, high_;  ///< where crumbs may lie, both included
  std::vector<Place> summits_;
  std::uint64_t harvest_ticks_;
  std::vector<Slot> slots_;
  Players<Player> players_;
  std::uint64_t changed_ = 0;
  // Of the crumbs that lie, as slots_ has them.
  double usual_way_;        ///< [m] in a step: who goes farther is held against every crumb
  CrumbMap map_of_crumbs_;  ///< for ways up to that
  std::array<core::Vec2, map::kMaxCrumbs> positions_;  ///< [m]
  std::uint64_t lying_ = 0;                            ///< their slots' bits
  bool is_map_stale_ = true;
  // Of the step that is judged.
  std::vector<core::Vec2> starts_;  ///< where the world's lice were
  std::array<Claim, map::kMaxCrumbs> claims_;
  std::uint64_t claimed_ = 0;  ///< the slots of whom claims_ says something
};

}  // namespace woodlouse::rules
