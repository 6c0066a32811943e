// A louse's play on a shipped map: where it starts and what it is told, so that the server's step at any rate
// and the reference go the same way.
//
// Thrusts change at the same moments whatever the rate (each 0.4 s, which is a whole number of ticks at every
// one of kGameRates), but for `each tick`: there each rate has a play of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "bench/lab/methods/laboratory.h"
#include "bench/lab/reference/motion.h"
#include "shared/map/map_definition.h"
#include "shared/physics/world.h"
#include "shared/state/louse.h"

namespace woodlouse::lab {

/// Ticks a second: every one has a whole number of ticks in 0.4 s.
inline constexpr std::array kGameRates = {15, 30, 60, 120, 240, 500, 1000};

/// Of maps that bear only so much of error [m/s of play].
inline constexpr std::array kTolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};

/// The map with that tolerance.
map::Map with_tolerance(const map::Map& map, double tolerance);

/// How a louse is steered.
enum class Play {
  kHeldVector,     ///< over a direction of the map, all the time
  kHeldHeading,    ///< along the heading
  kPulsedVector,   ///< 0.4 s elsewhere each time, 0.4 s nothing
  kPulsedHeading,  ///< 0.4 s along the heading, 0.4 s a brake or nothing
  kVectorEachTick,
  kHeadingEachTick,  ///< of both signs
};
inline constexpr std::array kPlays = {Play::kHeldVector,    Play::kHeldHeading,    Play::kPulsedVector,
                                      Play::kPulsedHeading, Play::kVectorEachTick, Play::kHeadingEachTick};
/// "held vector" and so on.
std::string_view to_text(Play play);
/// Whether its thrusts change with the ticks.
constexpr bool is_of_ticks(Play play) {
  return play == Play::kVectorEachTick || play == Play::kHeadingEachTick;
}

constexpr bool is_along_heading(Play play) {
  return play == Play::kHeldHeading || play == Play::kPulsedHeading || play == Play::kHeadingEachTick;
}

/// The thrust in the `part`-th part, of 0.4 s or a tick, of the louse of that seed.
state::Thrust thrust_in(Play play, std::uint64_t seed, std::uint64_t part);

/// Lice at rest or in motion all over the map, ids from 1 on.
std::vector<state::Louse> starting_lice(const map::Map& map, std::size_t count, std::uint64_t seed);

/// Whether the lab has a reference and rivals for a map: the exact equations over a spline or a plane.
bool is_measured(const map::Map& map);

/// The world of a map by one of the lab's methods; null: the method is not for its ground.
std::unique_ptr<physics::World> world_of(const map::Map& map, Integrator integrator, int rate);

/// Tells lice what `play` says at that tick, where it changes; from the louse's id as seed.
void steer(physics::World& world, Play play, int rate, std::uint64_t tick);

/// Moves a world on that was made for `rate`, steered so.
void play_on(physics::World& world, Play play, int rate, std::uint64_t first_tick, std::uint64_t ticks);

/// Where a louse is after `seconds`, a multiple of 0.4; rate: only of plays of ticks.
reference::Motion true_way(const map::Map& map, const state::Louse& start, Play play, int rate,
                           double seconds, const reference::Care& care = {});

/// How far a louse is from where it should be [m], the shorter way round where the edges wrap; in flight in
/// space.
double error_of(const map::Map& map, const state::Louse& louse, const reference::Motion& truth);

}  // namespace woodlouse::lab
