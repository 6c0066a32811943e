// How long it takes to get somewhere, guessed: straight ahead with full thrust, by what the heights on the
// way cost; where that is more than the thrust gives and the run-up holds, by what it takes to swing up to
// it.
#pragma once

#include "server/bots/goal.h"
#include "shared/map/map_definition.h"
#include "shared/rules/gate.h"
#include "shared/state/louse.h"
#include "shared/terrain/surface.h"

namespace woodlouse::server::bots {

class Effort {
 public:
  /// map: outlives it. power: of 1, what is pushed with at most.
  Effort(const map::Map& map, double power);

  /// Guessed seconds until the louse is there.
  [[nodiscard]] double seconds_to(const state::Louse& louse, const Goal& goal) const;
  /// Where to head for it: a point of the gate that lies ahead, before it where the louse is behind it.
  [[nodiscard]] core::Vec2 aim(const state::Louse& louse, const Goal& goal) const;
  /// The ground at a place, which may be an image outside of the map, or past its edge.
  [[nodiscard]] terrain::SurfaceSample ground(core::Vec2 place) const;
  /// What is left of it beside friction on level ground [m/s^2].
  [[nodiscard]] double thrust() const { return thrust_; }
  /// rules::climbable_slope() of the map.
  [[nodiscard]] double climbable() const { return climbable_; }
  [[nodiscard]] const rules::Images& images() const { return images_; }
  [[nodiscard]] const map::Map& map() const { return *map_; }

 private:
  /// A straight way, as it would be driven.
  struct Leg {
    double seconds = 0.0;
    double lack = 0.0;   ///< [J/kg]
    double speed = 0.0;  ///< at its end [m/s]
  };
  [[nodiscard]] Leg leg(core::Vec2 from, double speed_ahead, core::Vec2 to, bool flies) const;
  [[nodiscard]] double with_swings(const Leg& leg) const;
  /// The same, from any velocity.
  [[nodiscard]] Leg way(core::Vec2 from, core::Vec2 velocity, core::Vec2 to, bool flies) const;

  const map::Map* map_;
  rules::Images images_;
  double thrust_, climbable_;
};

}  // namespace woodlouse::server::bots
