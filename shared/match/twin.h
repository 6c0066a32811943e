// How far a game goes astray, for who asks: a twin of its world at half the step, told the same inputs,
// beside it for a while; then it begins anew where the game is. What local errors (step_error.h) become.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "shared/map/map_definition.h"
#include "shared/physics/world.h"
#include "shared/state/louse.h"
#include "shared/state/mode.h"

namespace woodlouse::match {

/// One thread at a time.
class Twin {
 public:
  static constexpr double kSeconds = 10.0;  ///< of a window

  /// tick: the room's [s], > 0. REQUIRES a map in full detail, which has the mode.
  Twin(const map::Map& map, double tick, state::Mode mode);

  /// The lice as a step finds them, with its inputs, and as it leaves them; both by ascending id, of the same
  /// lice. One that was moved otherwise since the last step (a respawn, a bump) begins a window anew, and so
  /// does one that was not there.
  void observe(std::span<const state::Louse> before, std::span<const state::Louse> after);

  /// Of each louse, for each window that it went through, how far the twin was away at its end [m], over the
  /// map.
  [[nodiscard]] const std::map<state::LouseId, std::vector<double>>& divergences() const {
    return divergences_;
  }

  /// How far a twin is away after the last step [m], over the map, and in which tick of its window.
  struct Apart {
    double metres = 0.0;
    std::uint64_t ticks = 0;
  };
  /// Nothing of who was not among the lice of the last step.
  [[nodiscard]] std::optional<Apart> apart(state::LouseId id) const;

 private:
  struct Pair {
    state::Louse game;        ///< as the last step left it
    std::uint64_t ticks = 0;  ///< of this window
  };

  void begin(std::span<const state::Louse> before);

  terrain::Rectangle domain_;
  state::Edges edges_;
  std::uint64_t window_;  ///< [ticks]
  physics::World world_;
  std::map<state::LouseId, Pair> pairs_;  ///< of the lice of the last step
  std::vector<state::Louse> lice_;
  std::map<state::LouseId, std::vector<double>> divergences_;
};

}  // namespace woodlouse::match
