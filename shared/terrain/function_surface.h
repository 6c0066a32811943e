// The five named functions as exact surfaces: z, gradient and Hessian in closed form. C-infinity.
//
// On the unit square x, y in [-1, 1], r^2 = x^2 + y^2:
//     parabolic_pot  0.5 r^2                                          (chapter 2.2 of the document)
//     wavy_pot       0.5 r^2 + 0.03 cos(2 pi x) cos(2 pi y)           (chapter 2.2)
//     volcano        0.5 r^2 + 0.02 / (r^2 + 0.1)                     (chapter 4.1)
//     hills          0.3 sin(2.3 x + 0.4) cos(1.7 y - 0.2) + 0.1 x y
//     waves          0.12 cos(pi x) cos(pi y) + 0.03 sin(2 pi x) sin(3 pi y), for maps whose edges wrap: the
//     square
//                    is a period
// A map of scale s is similar to it: z(x, y) = s f(x/s, y/s) on [-s, s]^2, so slopes stay and curvatures
// are divided by s. sin and cos are our own (core/portable_trigonometry.h): the same bits everywhere.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

enum class FunctionName { kParabolicPot, kWavyPot, kVolcano, kHills, kWaves };

inline constexpr std::array kFunctionNames = {FunctionName::kParabolicPot, FunctionName::kWavyPot,
                                              FunctionName::kVolcano, FunctionName::kHills,
                                              FunctionName::kWaves};

/// parabolic_pot, wavy_pot, volcano, hills, waves.
std::string_view to_text(FunctionName name);
std::optional<FunctionName> function_from_text(std::string_view text);

class FunctionSurface {
 public:
  /// scale [m] > 0: half the side of the square.
  FunctionSurface(FunctionName name, double scale) : name_(name), scale_(scale) {}

  [[nodiscard]] SurfaceSample sample(double x, double y) const;
  [[nodiscard]] Rectangle domain() const { return {-scale_, -scale_, scale_, scale_}; }
  [[nodiscard]] double cell() const { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] FunctionName name() const { return name_; }
  [[nodiscard]] double scale() const { return scale_; }

 private:
  FunctionName name_;
  double scale_;
};

/// The heights of a function at (2 grid + 1)^2 knots over [-scale, scale]^2; grid >= 2.
HeightGrid sample_function(FunctionName name, double scale, std::size_t grid);

}  // namespace woodlouse::terrain
