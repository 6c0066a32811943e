#include "shared/document/spline.h"

#include <cassert>

namespace woodlouse::document {
namespace {

using VecTyp = std::array<double, Spline::kMaxKnots>;
using SplAux = std::array<double, Spline::kMaxKnots + 1>;

struct CoefOne {
  double c3, c2, c1, c0;
};
using CoefTyp = std::array<CoefOne, Spline::kMaxKnots>;

constexpr double kD6 = 1.0 / 6.0;
constexpr double kM6 = 6.0;

/// The curvatures xx[0..p] of the natural spline through Vec[0..p]: the part that CofSpline and ValSpline
/// share. Work arrays are the caller's, as the document's are locals of each procedure.
inline void solve_curvatures(std::size_t p, const VecTyp& vec, SplAux& mm, SplAux& yy, SplAux& xx) {
  const std::size_t n = p - 1;
  mm[1] = 0.25;
  for (std::size_t j = 1; j + 1 <= n; ++j) mm[j + 1] = 1.0 / (4.0 - mm[j]);
  yy[1] = kM6 * (vec[2] - 2.0 * vec[1] + vec[0]);
  for (std::size_t j = 2; j <= n; ++j) {
    yy[j] = kM6 * (vec[j + 1] - 2.0 * vec[j] + vec[j - 1]) - yy[j - 1] * mm[j - 1];
  }
  xx[n + 1] = 0.0;
  xx[0] = 0.0;
  xx[n] = yy[n] * mm[n];
  for (std::size_t j = n - 1; j >= 1; --j) xx[j] = (yy[j] - xx[j + 1]) * mm[j];
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): by value, as printed.
[[gnu::noinline]] void cof_spline(std::size_t p, VecTyp vec, CoefTyp& c) {
  SplAux mm, yy, xx;
  solve_curvatures(p, vec, mm, yy, xx);
  double xxi = xx[0];
  double vei = vec[0];
  for (std::size_t i = 0; i < p; ++i) {
    const double xxp = xx[i + 1];
    const double vep = vec[i + 1];
    c[i] = {(xxp - xxi) * kD6, 0.5 * xxi, vep - vei - (xxp + 2.0 * xxi) * kD6, vei};
    xxi = xxp;
    vei = vep;
  }
}

/// Round(x - 0.5), kept to 0..last: the cell that holds x. Halves go to even in Pascal, so a knot may count
/// to either of its cells; the spline is the same from both. NaN gives 0.
std::size_t cell_of(double x, std::size_t last) {
  if (!(x > 0.0)) return 0;
  if (x >= static_cast<double>(last)) return last;
  return static_cast<std::size_t>(x);
}

struct ValueAndSlope {
  double z;
  double zx;
};

// NOLINTNEXTLINE(performance-unnecessary-value-param): by value, as printed.
[[gnu::noinline]] ValueAndSlope val_spline(std::size_t p, VecTyp vec, double x) {
  SplAux mm, yy, xx;
  solve_curvatures(p, vec, mm, yy, xx);
  const std::size_t i = cell_of(x, p - 1);
  const double c3 = (xx[i + 1] - xx[i]) * kD6;
  const double c2 = 0.5 * xx[i];
  const double c1 = vec[i + 1] - vec[i] - (xx[i + 1] + 2.0 * xx[i]) * kD6;
  const double c0 = vec[i];
  const double dx = x - static_cast<double>(i);
  double z = c3;
  double zx = c3;
  z = c2 + dx * z;
  zx = z + dx * zx;
  z = c1 + dx * z;
  zx = z + dx * zx;
  z = c0 + dx * z;
  return {z, zx};
}

}  // namespace

Spline::Spline(const terrain::HeightGrid& grid)
    : domain_(grid.domain()), dx_(grid.dx), dy_(grid.dy), columns_(grid.columns), rows_(grid.rows) {
  assert(columns_ >= kMinKnots && columns_ <= kMaxKnots && rows_ >= kMinKnots && rows_ <= kMaxKnots);
  knots_.resize(columns_ * rows_);
  VecTyp vec{};
  CoefTyp cof{};
  for (std::size_t k = 0; k < rows_; ++k) {
    for (std::size_t i = 0; i < columns_; ++i) vec[i] = grid.at(i, k);
    cof_spline(columns_ - 1, vec, cof);
    for (std::size_t i = 0; i + 1 < columns_; ++i) {
      knots_[k * columns_ + i] = {cof[i].c3, cof[i].c2, cof[i].c1, cof[i].c0, vec[i]};
    }
    knots_[(k + 1) * columns_ - 1] = {0.0, 0.0, 0.0, 0.0, vec[columns_ - 1]};
  }
}

terrain::SurfaceSample Spline::sample(double x, double y) const {
  const double xs = (x - domain_.x_min) / dx_;
  const double ys = (y - domain_.y_min) / dy_;
  const std::size_t xi = cell_of(xs, columns_ - 2);
  const double dx = xs - static_cast<double>(xi);
  VecTyp vecf;
  VecTyp vecd;
  for (std::size_t k = 0; k < rows_; ++k) {
    const Knot& a = knots_[k * columns_ + xi];
    vecf[k] = dx * (dx * (dx * a.a3 + a.a2) + a.a1) + a.a0;
    vecd[k] = dx * (3.0 * dx * a.a3 + 2.0 * a.a2) + a.a1;
  }
  const ValueAndSlope z = val_spline(rows_ - 1, vecf, ys);
  const ValueAndSlope zx = val_spline(rows_ - 1, vecd, ys);
  return {z.z, zx.z / dx_, z.zx / dy_, terrain::kNoHessian, terrain::kNoHessian, terrain::kNoHessian};
}

}  // namespace woodlouse::document
