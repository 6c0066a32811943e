// The error figure (shared/match/step_error.h) against the truth.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "bench/lab/game/scene.h"
#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// Ticks of lice that moved, or began to: what is told of their error, and what it was.
struct LocalErrors {
  std::size_t unforeseen = 0;  ///< where the reference gave up; not in the others
  std::vector<double> bounds;  ///< [m], match::distance_apart
  std::vector<double> truths;  ///< of the same ticks [m]

  void add(const LocalErrors& others);
  [[nodiscard]] double too_small() const;  ///< share of the ticks whose bound is below the truth
  /// That share of the ticks with an error has a smaller bound / truth.
  [[nodiscard]] double ratio_at(double share) const;
};

/// `ticks` ticks of lice that are so played, each stride-th of all; true: by the reference, or, where the
/// map is not for it, in 16 times as many parts.
LocalErrors local_errors(const map::Map& map, const std::vector<state::Louse>& lice, Play play, int rate,
                         std::size_t ticks, std::size_t stride);

/// Every map of `folder` (empty: the project's own) with its own method, each of kPlays, at four rates.
/// Writes lab-local-error.csv and draws it.
core::Expected<void> measure_local_error(const std::filesystem::path& folder, const Output& output);

/// The same maps with tolerances: which ticks err more than they bear, and by how much. Writes
/// lab-tolerance.csv.
core::Expected<void> measure_tolerance(const std::filesystem::path& folder, const Output& output);

}  // namespace woodlouse::lab
