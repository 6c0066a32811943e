#include "shared/rules/bump.h"

#include <cassert>
#include <cmath>

namespace woodlouse::rules {
namespace {

/// G^-1 n
core::Vec2 yields(core::Vec2 gradient, core::Vec2 n) {
  const double part = core::dot(gradient, n) / (1.0 + core::dot(gradient, gradient));
  return n - part * gradient;
}

core::Vec2 direction(core::Vec2 between) {
  constexpr double kTogether2 = 1e-24;  // [m^2]
  return core::dot(between, between) < kTogether2 ? core::Vec2{1.0, 0.0} : between;
}

}  // namespace

bool is_approach(core::Vec2 between, core::Vec2 first, core::Vec2 second) {
  return core::dot(direction(between), second - first) < 0.0;
}

double closing_speed(core::Vec2 between, core::Vec2 first, core::Vec2 second) {
  const core::Vec2 n = direction(between);
  return core::dot(n, first - second) / std::sqrt(core::dot(n, n));
}

std::optional<Bump> bump(core::Vec2 between, const Body& first, const Body& second, double restitution) {
  assert(restitution >= 0.0 && restitution <= 1.0);
  const core::Vec2 n = direction(between);
  const double u = core::dot(n, second.velocity - first.velocity);
  if (!(u < 0.0)) return std::nullopt;
  const core::Vec2 first_yields = yields(first.gradient, n), second_yields = yields(second.gradient, n);
  const double j = -(1.0 + restitution) * u / (core::dot(n, first_yields) + core::dot(n, second_yields));
  return Bump{first.velocity - j * first_yields, second.velocity + j * second_yields,
              j * std::sqrt(core::dot(n, n))};
}

}  // namespace woodlouse::rules
