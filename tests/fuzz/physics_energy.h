// That the physics makes no energy: what a louse may have after a tick.
#pragma once

#include <algorithm>
#include <cmath>

#include "shared/core/vec2.h"
#include "shared/physics/central_gravity.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::fuzz {

/// Of a map with the exact equations, per unit mass [m^2/s^2]. Refers to both.
class EnergyLaw {
 public:
  EnergyLaw(const terrain::Terrain& terrain, const state::Parameters& parameters)
      : terrain_(terrain), parameters_(parameters) {
    const terrain::HeightGrid looks = terrain::sample_grid(terrain, kLooks, kLooks);
    const auto [low, high] = std::minmax_element(looks.heights.begin(), looks.heights.end());
    lowest_ = *low;
    highest_ = *high;
    for (std::size_t k = 0; k < looks.heights.size(); ++k) {
      if (is_pit(looks, k)) lowest_ = std::min(lowest_, pit_bottom(looks, k));
    }
  }

  /// Kinetic and potential energy together.
  [[nodiscard]] double of(const state::Louse& louse) const {
    const double z = louse.phase == state::Phase::kFlying
                         ? louse.flight_z
                         : terrain_.sample(louse.position.x, louse.position.y).z;
    return kinetic(louse) + parameters_.gravity * z + pull_of(louse.position);
  }

  /// What a louse has above one at rest in the map's lowest place, the core's bottom included: where that is
  /// lower than anybody looked, at least what it moves with.
  [[nodiscard]] double above_floor(const state::Louse& louse) const {
    return std::max(kinetic(louse), of(louse) - parameters_.gravity * lowest_ - pull_of({}));
  }

  /// The most that of() may be after a tick of `step` seconds that began with this louse: what its push can
  /// have given, and what the method may err.
  [[nodiscard]] double most_after(const state::Louse& before, double step) const {
    const double push = most_of_push(before, step);
    return of(before) + push + error_share() * (above_floor(before) + push) + rounding();
  }

  /// Of what there was above the floor, what `after` has beyond what the push can have given; 0 or more.
  [[nodiscard]] double gained_share(const state::Louse& before, double after, double step) const {
    const double push = most_of_push(before, step);
    const double gain = after - of(before) - push - rounding();
    return gain > 0.0 ? gain / (above_floor(before) + push) : 0.0;
  }

  /// What a tick may err by, of above_floor().
  [[nodiscard]] double error_share() const {
    return parameters_.method == state::Method::kCheap ? 1e-2 : 1e-3;
  }

 private:
  static constexpr std::size_t kLooks = 49;  // each way: four a cell and more

  /// Whether no look beside this one is lower.
  static bool is_pit(const terrain::HeightGrid& looks, std::size_t k) {
    const std::size_t column = k % kLooks, row = k / kLooks;
    const double z = looks.heights[k];
    return (column == 0 || looks.heights[k - 1] >= z) &&
           (column + 1 == kLooks || looks.heights[k + 1] >= z) &&
           (row == 0 || looks.heights[k - kLooks] >= z) &&
           (row + 1 == kLooks || looks.heights[k + kLooks] >= z);
  }

  /// How deep the ground is around a look: by ever shorter ways down.
  [[nodiscard]] double pit_bottom(const terrain::HeightGrid& looks, std::size_t k) const {
    const terrain::Rectangle& domain = terrain_.domain();
    core::Vec2 place{looks.x_origin + static_cast<double>(k % kLooks) * looks.dx,
                     looks.y_origin + static_cast<double>(k / kLooks) * looks.dy};
    double z = looks.heights[k];
    constexpr int kShorter = 30;
    double part = 0.5;
    for (int i = 0; i < kShorter; ++i, part *= 0.6) {
      for (const core::Vec2 way :
           {core::Vec2{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
        const double x = std::clamp(place.x + part * looks.dx * way.x, domain.x_min, domain.x_max);
        const double y = std::clamp(place.y + part * looks.dy * way.y, domain.y_min, domain.y_max);
        const double there = terrain_.sample(x, y).z;
        if (!(there < z)) continue;
        z = there;
        place = {x, y};
      }
    }
    return z;
  }

  /// A push of f m/s^2 gives dE/dt <= f |v|3, and |v|3^2 / 2 is at most what is above the floor, whose root
  /// therefore grows by at most f step / sqrt(2).
  [[nodiscard]] double most_of_push(const state::Louse& before, double step) const {
    if (before.thrust_kind == state::ThrustKind::kAlongHeading && before.thrust.x < 0.0)
      return 0.0;  // a brake
    const double gain = parameters_.thrust_max * std::sqrt(core::dot(before.thrust, before.thrust)) * step;
    return gain * (std::sqrt(2.0 * above_floor(before)) + 0.5 * gain);
  }

  [[nodiscard]] double kinetic(const state::Louse& louse) const {
    const core::Vec2 v = louse.velocity;
    double climb = louse.flight_vz;
    if (louse.phase != state::Phase::kFlying) {
      const auto s = terrain_.sample(louse.position.x, louse.position.y);
      climb = s.zx * v.x + s.zy * v.y;
    }
    return 0.5 * (core::dot(v, v) + climb * climb);
  }

  [[nodiscard]] double pull_of(core::Vec2 place) const {
    return parameters_.central_gravity > 0.0 ? physics::central_potential(place, parameters_) : 0.0;
  }

  /// Of the terms that an energy is the sum of.
  [[nodiscard]] double rounding() const {
    constexpr double kRounding = 1e-12;
    return kRounding *
           (parameters_.gravity * std::max(std::abs(lowest_), std::abs(highest_)) + std::abs(pull_of({})));
  }

  const terrain::Terrain& terrain_;
  const state::Parameters& parameters_;
  double lowest_ = 0.0;
  double highest_ = 0.0;
};

}  // namespace woodlouse::fuzz
