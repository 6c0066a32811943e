#include "bench/lab/game/energy.h"

#include <cmath>
#include <limits>

#include "shared/physics/central_gravity.h"

namespace woodlouse::lab {
namespace {

/// In space [m/s].
double speed_of(const terrain::Terrain& ground, const state::Louse& louse) {
  const terrain::SurfaceSample s = ground.sample(louse.position.x, louse.position.y);
  const double vz = state::vertical_speed(louse, {s.zx, s.zy});
  return std::sqrt(dot(louse.velocity, louse.velocity) + vz * vz);
}

double potential(const state::Parameters& p, core::Vec2 x, double z) {
  return p.gravity * z + (p.central_gravity > 0.0 ? physics::central_potential(x, p) : 0.0);
}

}  // namespace

double energy_of(const terrain::Terrain& ground, const state::Parameters& parameters,
                 const state::Louse& louse) {
  const core::Vec2 x = louse.position;
  const core::Vec2 v = louse.velocity;
  const terrain::SurfaceSample s = ground.sample(x.x, x.y);
  const double vz = state::vertical_speed(louse, {s.zx, s.zy});
  const double z = louse.phase == state::Phase::kFlying ? louse.flight_z : s.z;
  return 0.5 * (dot(v, v) + vz * vz) + potential(parameters, x, z);
}

double lowest_energy(const terrain::Terrain& ground, const state::Parameters& parameters) {
  constexpr int kPlaces = 240;  // a side, and as many again
  const terrain::Rectangle domain = ground.domain();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kPlaces; ++i) {
    for (int j = 0; j <= kPlaces; ++j) {
      const core::Vec2 x{std::fmin(domain.x_min + (domain.x_max - domain.x_min) * i / kPlaces, domain.x_max),
                         std::fmin(domain.y_min + (domain.y_max - domain.y_min) * j / kPlaces, domain.y_max)};
      least = std::fmin(least, potential(parameters, x, ground.sample(x.x, x.y).z));
    }
  }
  return least;
}

EnergyWatch::EnergyWatch(const physics::World& world, bool is_kept)
    : world_(world), is_kept_(is_kept), bottom_(lowest_energy(world.terrain(), world.parameters())) {
  for (const state::Louse& louse : world.lice()) {
    may_have_.push_back(energy_of(world.terrain(), world.parameters(), louse));
    scale_.push_back(std::fmax(may_have_.back() - bottom_, 1e-6));
    way_.push_back(louse.distance);
    speed_.push_back(speed_of(world.terrain(), louse));
  }
}

void EnergyWatch::look() {
  const terrain::Rectangle domain = world_.terrain().domain();
  for (std::size_t k = 0; k < may_have_.size(); ++k) {
    const state::Louse& louse = world_.lice()[k];
    const core::Vec2 x = louse.position;
    if (!std::isfinite(x.x + x.y + louse.velocity.x + louse.velocity.y)) {
      ++not_finite_;
      gained_ = std::numeric_limits<double>::infinity();
      continue;
    }
    if (!domain.contains(x.x, x.y)) {
      ++outside_;
      continue;
    }
    const double now = energy_of(world_.terrain(), world_.parameters(), louse);
    const double speed = speed_of(world_.terrain(), louse);
    const bool is_pushed = louse.thrust_kind == state::ThrustKind::kMapVector ||
                           (louse.thrust_kind == state::ThrustKind::kAlongHeading && louse.thrust.x > 0.0);
    if (is_pushed) {
      // At most all of it along the way: which a method may tell too short where the louse turned back on it.
      const double push = world_.parameters().thrust_max * std::sqrt(dot(louse.thrust, louse.thrust));
      const double most = world_.step_seconds() * std::fmax(speed_[k], speed);
      may_have_[k] += push * std::fmax(louse.distance - way_[k], most);
      scale_[k] = std::fmax(scale_[k], may_have_[k] - bottom_);
    }
    way_[k] = louse.distance;
    speed_[k] = speed;
    const double beyond = (now - may_have_[k]) / scale_[k];
    gained_ = std::fmax(gained_, beyond);
    if (is_kept_) {
      lost_ = std::fmax(lost_, -beyond);
    } else {
      may_have_[k] = std::fmin(may_have_[k], now);
    }
  }
}

}  // namespace woodlouse::lab
