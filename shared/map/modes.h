// The modes of play that a map has, as its file says: field by field in maps/README.md. How they are played:
// shared/rules.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/state/mode.h"

namespace woodlouse::map {

inline constexpr std::size_t kMinGates = 2, kMaxGates = 32;
inline constexpr std::size_t kMaxCrumbs = 64;
inline constexpr std::size_t kMaxPlaces = 16;

struct SpawnPoint {
  core::Vec2 position;           ///< [m], inside the domain
  core::Vec2 heading{1.0, 0.0};  ///< unit vector
  double speed = 0.0;            ///< over the map, along the heading [m/s]
  friend bool operator==(const SpawnPoint&, const SpawnPoint&) = default;
};

/// A line from a to b that is driven through from its right-hand side to its left, at any height.
struct Gate {
  core::Vec2 a, b;      ///< [m]
  bool in_air = false;  ///< counts only for who flies
  friend bool operator==(const Gate&, const Gate&) = default;
};

/// As often as one likes through all gates, against the clock.
struct RaceMode {
  std::uint32_t laps = 3;            ///< of a run
  std::vector<Gate> gates;           ///< kMinGates..kMaxGates; the first is start and finish
  std::uint32_t round_s = 300;       ///< [s]
  std::uint32_t podium_s = 10;       ///< [s]
  std::uint64_t author_ms = 0;       ///< the time to beat; no part of the map's hash; 0: none
  std::vector<SpawnPoint> spawns{};  ///< at rest, before the first gate; empty: the map's
  friend bool operator==(const RaceMode&, const RaceMode&) = default;
};

/// Crumbs that lie about; three times as much on summits.
struct ForageMode {
  std::uint32_t crumbs = 24;    ///< 1..kMaxCrumbs
  double radius = 0.9;          ///< within which one is eaten [m]
  std::uint32_t round_s = 180;  ///< [s]
  std::uint32_t podium_s = 10;  ///< [s]
  std::uint32_t summits = 4;    ///< how many of the crumbs lie on summits, on average; at most crumbs
  friend bool operator==(const ForageMode&, const ForageMode&) = default;
};

struct HillPlace {
  core::Vec2 at;        ///< [m]
  double radius = 3.0;  ///< [m]
  friend bool operator==(const HillPlace&, const HillPlace&) = default;
};

/// Who is alone on the place holds it; who holds it longest wins.
struct HillMode {
  std::vector<HillPlace> places;  ///< 1..kMaxPlaces, one after the other
  std::uint32_t hold_s = 60;      ///< that wins the round [s]
  std::uint32_t move_s = 45;      ///< after which the next place counts [s]
  double bump_radius = 0.8;       ///< of a louse, to the others [m]; 0: they pass through each other
  double bump_restitution = 0.8;  ///< 0..1
  bool falls = false;             ///< edge "fall": who leaves the map is out
  std::uint32_t out_s = 2;        ///< for so long [s]
  std::uint32_t podium_s = 10;    ///< [s]
  friend bool operator==(const HillMode&, const HillMode&) = default;
};

struct Modes {
  std::optional<RaceMode> race;
  std::optional<ForageMode> forage;
  std::optional<HillMode> hill;

  /// Roam is in every map.
  [[nodiscard]] bool has(state::Mode mode) const {
    switch (mode) {
      case state::Mode::kRace:
        return race.has_value();
      case state::Mode::kForage:
        return forage.has_value();
      case state::Mode::kHill:
        return hill.has_value();
      case state::Mode::kRoam:
        break;
    }
    return true;
  }
  friend bool operator==(const Modes&, const Modes&) = default;
};

}  // namespace woodlouse::map
