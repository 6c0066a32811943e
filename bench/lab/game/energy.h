// What energy a louse has, and how much of it nobody gave.
#pragma once

#include <cstddef>
#include <vector>

#include "shared/physics/world.h"

namespace woodlouse::lab {

/// Kinetic and potential, of gravity and the centre [m^2/s^2].
double energy_of(const terrain::Terrain& ground, const state::Parameters& parameters,
                 const state::Louse& louse);

/// The least that a louse can have, but for what lies between the places looked at.
double lowest_energy(const terrain::Terrain& ground, const state::Parameters& parameters);

/// Watches a world's lice tick by tick.
class EnergyWatch {
 public:
  /// is_kept: whether nothing takes energy from them: then it may not rise above the start's, else not above
  /// the least so far. REQUIRES that the world outlives this.
  EnergyWatch(const physics::World& world, bool is_kept);

  /// After each step.
  void look();

  /// The most that any louse had beyond what it may have, of what that is above the lowest place; infinite
  /// where something is no number.
  [[nodiscard]] double gained() const { return gained_; }
  /// Where nothing takes energy: the most that was lost, likewise.
  [[nodiscard]] double lost() const { return lost_; }
  [[nodiscard]] std::size_t not_finite() const { return not_finite_; }  ///< lice, looks added up
  [[nodiscard]] std::size_t outside() const { return outside_; }        ///< of the map, likewise

 private:
  const physics::World& world_;
  bool is_kept_;
  double bottom_;
  std::vector<double> may_have_, scale_, way_, speed_;
  double gained_ = 0.0, lost_ = 0.0;
  std::size_t not_finite_ = 0, outside_ = 0;
};

}  // namespace woodlouse::lab
