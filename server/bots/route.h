// The fields of a race's gates, made once for all who drive it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "server/bots/gate_field.h"
#include "server/bots/goal.h"
#include "server/bots/ground_moves.h"
#include "shared/map/modes.h"

namespace woodlouse::server::bots {

class Route {
 public:
  /// Both outlive it. Takes some hundredths of a second a gate. Of a map in tiles no field is made: it would
  /// build them all.
  Route(const map::RaceMode& mode, const Effort& effort);

  [[nodiscard]] std::size_t size() const { return goals_.size(); }
  /// The gate of that number, with its field, if there is one, and its credit.
  [[nodiscard]] const Goal& goal(std::size_t gate) const { return goals_[gate % goals_.size()]; }

 private:
  std::optional<GroundMoves> moves_;
  std::vector<std::unique_ptr<GateField>> alone_, in_order_;  ///< of a gate; of it and the one behind it
  std::vector<Goal> goals_;
};

}  // namespace woodlouse::server::bots
