// How far the steps of a game err, for who asks. No room's step knows of it: whoever wants to know steps the
// same ticks once more, in worlds of his own.
//
// Each tick is stepped from the state it began with, as the room does and in kParts parts; what the two ends
// differ by is what the step erred, but for the little that the parts err (docs/physics.md: why so, and how
// near it comes to the truth). So walls, seams, flights, stops, every force and every method count alike.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "shared/map/map_definition.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/world.h"
#include "shared/state/louse.h"
#include "shared/state/mode.h"

namespace woodlouse::match {

/// A tick of a map's world in so many equal parts. One thread at a time.
class PartedTick {
 public:
  /// tick: [s], > 0; parts > 0. REQUIRES a map in full detail, which has the mode.
  PartedTick(const map::Map& map, double tick, state::Mode mode, std::uint32_t parts);

  /// The lice at the end of the tick that begins with these, by ascending id, their thrusts acting all the
  /// while; valid until the next call. Thrusts are not counted down. REQUIRES a state that a step or an input
  /// of such a world left.
  std::span<const state::Louse> run(std::span<const state::Louse> lice);

 private:
  physics::World world_;
  std::uint32_t parts_;
  std::vector<state::Louse> held_;
};

/// How far apart two places over the map are [m]; by the shorter way round where the edges wrap.
double distance_over_map(core::Vec2 a, core::Vec2 b, const terrain::Rectangle& domain, state::Edges edges);

/// How far apart two states of a louse are [m]: their places over the map, and as far as their velocities
/// lead apart in kAhead, if nothing else does.
inline constexpr double kAhead = physics::kAhead;  // [s]
double distance_apart(const state::Louse& a, const state::Louse& b, const terrain::Rectangle& domain,
                      state::Edges edges);

/// What the ticks of one louse erred.
struct ErrorFigure {
  std::uint64_t ticks = 0;
  double sum = 0.0;              ///< of the ticks' bounds [m]
  double worst = 0.0;            ///< of one tick [m]
  std::uint64_t worst_tick = 0;  ///< the first tick that erred so
};

/// Bounds of the local error, tick by tick. One thread at a time.
class StepError {
 public:
  /// A sub-step is halved only where the state asks for it: fewer parts would often be the steps of the room.
  static constexpr std::uint32_t kParts = 64;
  /// Of what whole and parts differ by.
  static constexpr double kSafety = 2.0;
  /// Of a place's and a velocity's last digit: what both round alike.
  static constexpr double kRounding = 4.0;

  /// tick: the room's [s], > 0. REQUIRES a map in full detail, which has the mode.
  StepError(const map::Map& map, double tick, state::Mode mode);
  StepError(const StepError&) = delete;
  StepError& operator=(const StepError&) = delete;

  /// The lice as the step of number `tick` finds them, by ascending id: with this step's inputs, not yet
  /// moved. Costs 1 + kParts steps and more memory only for lice not seen before.
  void observe(std::span<const state::Louse> lice, std::uint64_t tick);

  /// Of the last tick observed, a bound [m] (distance_apart) for each of its lice, in their order.
  [[nodiscard]] std::span<const double> bounds() const { return bounds_; }
  /// The same lice at the end of that tick, bit for bit as a room has them, but for thrusts that end then.
  [[nodiscard]] std::span<const state::Louse> stepped() const { return stepped_; }
  /// Of every louse that was ever observed.
  [[nodiscard]] const std::map<state::LouseId, ErrorFigure>& figures() const { return figures_; }
  /// The error figure: metres that a second of play errs [m/s of play]; 0 before the first tick.
  [[nodiscard]] double of_play(const ErrorFigure& figure) const;

 private:
  double tick_seconds_;
  terrain::Rectangle domain_;
  state::Edges edges_;
  PartedTick whole_, parts_;
  std::span<const state::Louse> stepped_;
  std::vector<double> bounds_;
  std::map<state::LouseId, ErrorFigure> figures_;
};

}  // namespace woodlouse::match
