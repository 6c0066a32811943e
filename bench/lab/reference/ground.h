// A map's ground for the reference: the polynomials that the map's spline is made of, cell by cell, or its
// plane, summed in long double by code of its own. The coefficients are the map's; nothing that evaluates
// them is.
#pragma once

#include "bench/lab/reference/dop853.h"
#include "shared/state/parameters.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::lab::reference {

/// Height [m], gradient [1] and Hessian [1/m] at a place.
struct Place {
  Real z = 0, zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
};

/// What holds one polynomial: a cell of the spline, or all of a plane.
struct Cell {
  long long column = 0, row = 0;
  Real x_min = 0, y_min = 0, x_max = 0, y_max = 0;  ///< [m]; at the rim that of the domain
};

class Ground {
 public:
  /// Whether a terrain is one of those known here: a spline or a plane.
  static bool knows(const terrain::Terrain& terrain);
  /// REQUIRES knows(terrain), which must outlive this.
  explicit Ground(const terrain::Terrain& terrain);

  [[nodiscard]] const terrain::Rectangle& domain() const { return domain_; }
  /// That holds at a place of the domain; on a line the one to the east or north, if there is one.
  [[nodiscard]] Cell cell_at(Real x, Real y) const;
  /// The next one, columns and rows on (-1, 0, 1); over the rim that of the opposite one.
  [[nodiscard]] Cell next(const Cell& cell, int columns, int rows) const;
  [[nodiscard]] Place at(const Cell& cell, Real x, Real y) const;

 private:
  [[nodiscard]] Cell numbered(long long column, long long row) const;

  terrain::Rectangle domain_;
  const terrain::PlaneSurface* plane_ = nullptr;
  const terrain::BicubicSpline* spline_ = nullptr;
  long long first_column_ = 0, first_row_ = 0;  ///< of the domain, among those stored
  long long columns_ = 1, rows_ = 1;
};

}  // namespace woodlouse::lab::reference
