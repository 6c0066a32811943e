// vspline behind a call that C++17 knows: its arrays (vigra's, as Debian has them) are no C++20.
#pragma once

#include <cstddef>
#include <memory>

namespace woodlouse::lab {

class VsplineSum {
 public:
  VsplineSum() = default;
  VsplineSum(const VsplineSum&) = delete;
  VsplineSum& operator=(const VsplineSum&) = delete;
  virtual ~VsplineSum() = default;
  /// Of z, gradient and Hessian by the knots' numbers, over `count` points x, y, x, y and so on, in knots.
  /// REQUIRES a count that vectors of points fill.
  [[nodiscard]] virtual double sum(const double* points, std::size_t count) const = 0;
};

/// A natural cubic b-spline, with an evaluator each for z, gradient and Hessian, a vector of points at once.
/// heights: row by row.
std::unique_ptr<VsplineSum> make_vspline_sum(std::size_t columns, std::size_t rows, const double* heights);

}  // namespace woodlouse::lab
