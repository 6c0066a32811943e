#include "shared/terrain/function_surface.h"

#include <cassert>
#include <cmath>

#include "shared/core/portable_trigonometry.h"

namespace woodlouse::terrain {
namespace {

constexpr double kTwoPi = 6.283185307179586476925286766559;
constexpr double kFarthest = 1e4;  // of the unit function, where portable_sincos still is one

SurfaceSample wavy_pot(double x, double y) {
  constexpr double kAmplitude = 0.03;
  const auto [sx, cx] = core::portable_sincos(kTwoPi * x);
  const auto [sy, cy] = core::portable_sincos(kTwoPi * y);
  const double slope = kAmplitude * kTwoPi;
  const double curvature = slope * kTwoPi;
  return {{0.5 * (x * x + y * y) + kAmplitude * cx * cy, x - slope * sx * cy, y - slope * cx * sy},
          1.0 - curvature * cx * cy,
          curvature * sx * sy,
          1.0 - curvature * cx * cy};
}

SurfaceSample volcano(double x, double y) {
  constexpr double kHeight = 0.02;
  constexpr double kWidth = 0.1;
  const double r2 = x * x + y * y;
  const double q = 1.0 / (r2 + kWidth);
  const double hq2 = kHeight * q * q;
  const double ring = 1.0 - 2.0 * hq2;  // zx = x ring
  const double bend = 8.0 * hq2 * q;    // d ring / dx = x bend
  return {
      {0.5 * r2 + kHeight * q, x * ring, y * ring}, ring + x * x * bend, x * y * bend, ring + y * y * bend};
}

SurfaceSample hills(double x, double y) {
  constexpr double kAmplitude = 0.3;
  constexpr double kA = 2.3;
  constexpr double kB = 1.7;
  constexpr double kTwist = 0.1;
  const auto [sa, ca] = core::portable_sincos(kA * x + 0.4);
  const auto [sb, cb] = core::portable_sincos(kB * y - 0.2);
  return {{kAmplitude * sa * cb + kTwist * x * y, kAmplitude * kA * ca * cb + kTwist * y,
           -kAmplitude * kB * sa * sb + kTwist * x},
          -kAmplitude * kA * kA * sa * cb,
          -kAmplitude * kA * kB * ca * sb + kTwist,
          -kAmplitude * kB * kB * sa * cb};
}

SurfaceSample waves(double x, double y) {
  constexpr double kHeight = 0.12;
  constexpr double kRipple = 0.03;
  constexpr double kPi = 0.5 * kTwoPi;
  const auto [sx, cx] = core::portable_sincos(kPi * x);
  const auto [sy, cy] = core::portable_sincos(kPi * y);
  const auto [s2x, c2x] = core::portable_sincos(kTwoPi * x);
  const auto [s3y, c3y] = core::portable_sincos(3.0 * kPi * y);
  return {{kHeight * cx * cy + kRipple * s2x * s3y, kPi * (2.0 * kRipple * c2x * s3y - kHeight * sx * cy),
           kPi * (3.0 * kRipple * s2x * c3y - kHeight * cx * sy)},
          -kPi * kPi * (kHeight * cx * cy + 4.0 * kRipple * s2x * s3y),
          kPi * kPi * (kHeight * sx * sy + 6.0 * kRipple * c2x * c3y),
          -kPi * kPi * (kHeight * cx * cy + 9.0 * kRipple * s2x * s3y)};
}

SurfaceSample unit_sample(FunctionName name, double x, double y) {
  switch (name) {
    case FunctionName::kParabolicPot:
      return {{0.5 * (x * x + y * y), x, y}, 1.0, 0.0, 1.0};
    case FunctionName::kWavyPot:
      return wavy_pot(x, y);
    case FunctionName::kVolcano:
      return volcano(x, y);
    case FunctionName::kHills:
      return hills(x, y);
    case FunctionName::kWaves:
      return waves(x, y);
  }
  assert(false);
  return {};
}

}  // namespace

std::string_view to_text(FunctionName name) {
  switch (name) {
    case FunctionName::kParabolicPot:
      return "parabolic_pot";
    case FunctionName::kWavyPot:
      return "wavy_pot";
    case FunctionName::kVolcano:
      return "volcano";
    case FunctionName::kHills:
      return "hills";
    case FunctionName::kWaves:
      return "waves";
  }
  assert(false);
  return {};
}

std::optional<FunctionName> function_from_text(std::string_view text) {
  for (const FunctionName name : kFunctionNames) {
    if (to_text(name) == text) return name;
  }
  return std::nullopt;
}

SurfaceSample FunctionSurface::sample(double x, double y) const {
  // A step that goes astray asks for places where no sine is known; what it finds there it can't use.
  const auto near = [](double u) { return u > -kFarthest ? (u < kFarthest ? u : kFarthest) : -kFarthest; };
  SurfaceSample s = unit_sample(name_, near(x / scale_), near(y / scale_));
  s.z *= scale_;
  s.zxx /= scale_;
  s.zxy /= scale_;
  s.zyy /= scale_;
  return s;
}

HeightGrid sample_function(FunctionName name, double scale, std::size_t grid) {
  assert(grid >= 2 && scale > 0.0);
  const std::size_t side = 2 * grid + 1;
  HeightGrid result;
  result.columns = side;
  result.rows = side;
  result.x_origin = -scale;
  result.y_origin = -scale;
  result.dx = result.dy = scale / static_cast<double>(grid);
  result.heights.reserve(side * side);
  const double n = static_cast<double>(grid);
  for (std::size_t j = 0; j < side; ++j) {
    const double y = (static_cast<double>(j) - n) / n;
    for (std::size_t i = 0; i < side; ++i) {
      const double x = (static_cast<double>(i) - n) / n;
      result.heights.push_back(scale * unit_sample(name, x, y).z);
    }
  }
  return result;
}

}  // namespace woodlouse::terrain
