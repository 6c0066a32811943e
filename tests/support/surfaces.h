// Surfaces with closed-form motion, for tests: each meets the Surface concept.
#pragma once

#include <cmath>
#include <limits>

#include "shared/terrain/surface.h"

namespace woodlouse::tests {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr terrain::Rectangle kNowhere{-kInfinity, -kInfinity, kInfinity, kInfinity};

struct Unbounded {
  [[nodiscard]] terrain::Rectangle domain() const { return kNowhere; }
  [[nodiscard]] double cell() const { return kInfinity; }
};

/// z = slope_x x + slope_y y.
struct Plane : Unbounded {
  double slope_x = 0.0;
  double slope_y = 0.0;
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    return {slope_x * x + slope_y * y, slope_x, slope_y, 0.0, 0.0, 0.0};
  }
};

/// z = a (x^2 + y^2).
struct Bowl : Unbounded {
  double a = 0.5;
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    return {a * (x * x + y * y), 2 * a * x, 2 * a * y, 2 * a, 0.0, 2 * a};
  }
};

/// z = k r, away from its tip.
struct Cone : Unbounded {
  double k = 0.7;
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    const double r = std::sqrt(x * x + y * y);
    const double r3 = r * r * r;
    return {k * r, k * x / r, k * y / r, k * y * y / r3, -k * x * y / r3, k * x * x / r3};
  }
};

/// z = a x^2: the same along every y.
struct Gutter : Unbounded {
  double a = 0.5;
  [[nodiscard]] terrain::SurfaceSample sample(double x, double) const {
    return {a * x * x, 2 * a * x, 0.0, 2 * a, 0.0, 0.0};
  }
};

/// The gutter whose section is the cycloid x = R (p + sin p), z = R (1 - cos p), |p| < pi.
struct CycloidGutter : Unbounded {
  double radius = 1.0;
  [[nodiscard]] terrain::SurfaceSample sample(double x, double) const {
    double p = 0.5 * x / radius;
    for (int i = 0; i < 50; ++i) p -= (p + std::sin(p) - x / radius) / (1 + std::cos(p));
    const double slope = std::tan(0.5 * p);
    const double bend = 0.5 * (1 + slope * slope) / (radius * (1 + std::cos(p)));
    return {radius * (1 - std::cos(p)), slope, 0.0, bend, 0.0, 0.0};
  }
};

}  // namespace woodlouse::tests
