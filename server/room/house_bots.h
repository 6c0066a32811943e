// The server's own players: four characters that look at the ground under them and push. They file inputs
// like everyone else; nothing of them is in the simulation, so they may use libm. Pure: no clock, no socket.
// The room's strand owns them.
#pragma once

#include <cstdint>
#include <string>

#include "shared/core/random.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {

enum class Character : std::uint8_t {
  kRoller,    ///< lets itself roll down, and kicks itself out again where it comes to rest
  kClimber,   ///< climbs; where the slope is too steep it swings to gain height, on the top it kicks itself
              ///< off
  kOrbiter,   ///< circles the middle of the map at its own radius
  kWanderer,  ///< drives from one random point to the next
};

/// What a bot sees.
struct View {
  const state::Louse& louse;
  const terrain::Terrain& terrain;
  const state::Parameters& parameters;
};

class HouseBot {
 public:
  static constexpr std::uint32_t kDecisionsPerSecond = 10;

  /// number: from 0; character and name follow from it, whims from the seed.
  HouseBot(std::uint32_t number, std::uint64_t seed);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Character character() const { return character_; }

  /// The thrust until the next decision: a map vector of length at most 1, in multiples of 1/128.
  state::Thrust decide(const View& view);

 private:
  core::Vec2 roll(const View& view);
  core::Vec2 climb(const View& view);
  core::Vec2 orbit(const View& view);
  core::Vec2 wander(const View& view);
  core::Vec2 kick();
  core::Vec2 random_direction();

  Character character_;
  std::string name_;
  core::Random random_;
  core::Vec2 kick_;              ///< a push that gets it out of where it came to rest
  std::uint32_t kick_left_ = 0;  ///< decisions that it still acts
  std::uint32_t stuck_ = 0;      ///< decisions running in which it hardly moved
  core::Vec2 waypoint_;          ///< the wanderer's [m]
  std::uint32_t patience_ = 0;   ///< decisions for which the waypoint still holds
  double radius_share_;          ///< orbit's radius as a share of the map's half side
  double turn_;                  ///< +1 counter-clockwise, -1 clockwise
};

}  // namespace woodlouse::server
