// The grounds of a batched step over a lane type L: where lanes are on them, and the sample there. Under the
// rules of kernel.h.
#pragma once

#include "shared/physics/batch.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

template <typename L>
class SplineLanes {
 public:
  using Sample = BasicSurfaceSample<L>;

  /// The lanes' cells and where in them the lanes are.
  struct Place {
    const double* cell[L::kCount];
    L u, v;
  };

  explicit SplineLanes(const BatchContext& context) : SplineLanes(context.spline) {}
  /// Refers to `spline`.
  explicit SplineLanes(const terrain::BicubicSpline::View& spline) : spline_(spline) {}

  /// Finds x's cells and asks the memory for them.
  [[gnu::always_inline]] inline void locate(Pair<L> x, Place& place) const {
    const L rx = x.x - L(spline_.x_origin);
    const L ry = x.y - L(spline_.y_origin);
    const L i = (rx * L(spline_.inverse_dx)).cell_index(spline_.last_column);
    const L j = (ry * L(spline_.inverse_dy)).cell_index(spline_.last_row);
    (j * L(spline_.last_column + 1.0) + i).store_pointers(spline_.cells, place.cell);
    place.u = rx - i * L(spline_.dx);
    place.v = ry - j * L(spline_.dy);
    for (std::size_t l = 0; l < static_cast<std::size_t>(L::kCount); ++l) {
      __builtin_prefetch(place.cell[l]);
      __builtin_prefetch(place.cell[l] + 8);
    }
  }

  [[gnu::always_inline]] inline Sample sample(const Place& place) const {
    L coefficients[16];
    const double* from[L::kCount];
    for (int part = 0; part < 16; part += L::kRow) {
      for (int l = 0; l < L::kCount; ++l) from[l] = place.cell[l] + part;
      L::load_transposed(from, coefficients + part);
    }
    return terrain::evaluate_cell(coefficients, place.u, place.v);
  }

 private:
  const terrain::BicubicSpline::View& spline_;
};

/// The slope is the same everywhere.
template <typename L>
class PlaneLanes {
 public:
  using Sample = BasicSlopeSample<L>;
  using Place = Pair<L>;

  explicit PlaneLanes(const BatchContext& context) : plane_(context.plane) {}

  [[gnu::always_inline]] inline void locate(Pair<L> x, Place& place) const { place = x; }
  /// As PlaneSurface::sample().
  [[gnu::always_inline]] inline Sample sample(const Place& x) const {
    const auto [height, corner, slope] = plane_;
    return {L(height) + L(slope.x) * (x.x - L(corner.x)) + L(slope.y) * (x.y - L(corner.y)), L(slope.x),
            L(slope.y)};
  }

 private:
  BatchContext::Plane plane_;
};

}  // namespace woodlouse::physics
