// Lice that come, go, move and stay, on a terrain: something for encoders to look at.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "server/frames/frame_encoder.h"
#include "shared/core/random.h"
#include "shared/physics/attitude.h"
#include "shared/terrain/function_surface.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server::test {

class Scenery {
 public:
  explicit Scenery(std::uint64_t seed)
      : terrain(terrain::FunctionSurface(terrain::FunctionName::kVolcano, 20.0)), random(seed) {
    for (int i = 0; i < 30; ++i) lice.push_back(louse());
  }

  [[nodiscard]] Scene scene() const { return {tick, tick / 3, lice, terrain, hash, link}; }

  /// The next tick: some go, some move, some come, most stay.
  void change() {
    ++tick;
    std::erase_if(lice, [this](const state::Louse&) { return random.uniform() < 0.05; });
    for (state::Louse& one : lice)
      if (random.uniform() < 0.3) one.position.x = -one.position.x;
    while (random.uniform() < 0.5) lice.push_back(louse());
  }

  terrain::Terrain terrain;
  core::Random random;
  std::uint64_t tick = 0;
  std::uint64_t hash = 4711;
  state::HashLink link;
  std::vector<state::Louse> lice;

 private:
  state::Louse louse() {
    const auto number = [this] { return 20.0 * (2.0 * random.uniform() - 1.0); };
    state::Louse one;
    one.id = next_id_++;
    one.phase = static_cast<state::Phase>(random.next() % 3);
    if (one.phase == state::Phase::kFlying) one.flight_z = number(), one.flight_vz = number();
    one.position = {number(), number()};
    one.velocity = {number(), number()};
    const double angle = number();
    one.heading = {std::cos(angle), std::sin(angle)};
    one.thrust = {0.25, -0.5};
    one.thrust_kind = state::ThrustKind::kMapVector;
    one.thrust_ticks = state::kHeld;
    one.distance = std::abs(number());
    return one;
  }

  std::uint32_t next_id_ = 1;
};

inline constexpr rules::Standing kStanding{-7, 3, 2, (std::uint64_t{1} << 40) + 5, 123456789};

/// A row as its definition says.
inline std::vector<double> values(const state::Louse& louse, const std::vector<protocol::Column>& columns,
                                  const terrain::Terrain& terrain, const rules::Standing& standing = {}) {
  using protocol::Column;
  const auto ground = terrain.sample(louse.position.x, louse.position.y);
  const physics::Attitude attitude = physics::attitude(louse.heading, {ground.zx, ground.zy});
  const double vz = louse.phase == state::Phase::kFlying
                        ? louse.flight_vz
                        : ground.zx * louse.velocity.x + ground.zy * louse.velocity.y;
  std::vector<double> row;
  for (const Column column : columns) {
    switch (column) {
      case Column::kScore:
        row.push_back(static_cast<double>(standing.score));
        break;
      case Column::kGate:
        row.push_back(standing.gate);
        break;
      case Column::kLap:
        row.push_back(standing.lap);
        break;
      case Column::kLapStart:
        row.push_back(static_cast<double>(standing.lap_start));
        break;
      case Column::kBestLap:
        row.push_back(static_cast<double>(standing.best_lap));
        break;
      case Column::kId:
        row.push_back(louse.id);
        break;
      case Column::kX:
        row.push_back(louse.position.x);
        break;
      case Column::kY:
        row.push_back(louse.position.y);
        break;
      case Column::kVx:
        row.push_back(louse.velocity.x);
        break;
      case Column::kVy:
        row.push_back(louse.velocity.y);
        break;
      case Column::kZ:
        row.push_back(louse.phase == state::Phase::kFlying ? louse.flight_z : ground.z);
        break;
      case Column::kHeadingX:
        row.push_back(louse.heading.x);
        break;
      case Column::kHeadingY:
        row.push_back(louse.heading.y);
        break;
      case Column::kYaw:
        row.push_back(attitude.yaw);
        break;
      case Column::kPitch:
        row.push_back(attitude.pitch);
        break;
      case Column::kRoll:
        row.push_back(attitude.roll);
        break;
      case Column::kSpeed:
        row.push_back(std::sqrt(core::dot(louse.velocity, louse.velocity) + vz * vz));
        break;
      case Column::kTx:
        row.push_back(louse.thrust.x);
        break;
      case Column::kTy:
        row.push_back(louse.thrust.y);
        break;
      case Column::kThrustKind:
        row.push_back(static_cast<double>(louse.thrust_kind));
        break;
      case Column::kTicksLeft:
        row.push_back(louse.thrust_ticks);
        break;
      case Column::kPhase:
        row.push_back(static_cast<double>(louse.phase));
        break;
      case Column::kFlightZ:
        row.push_back(louse.flight_z);
        break;
      case Column::kFlightVz:
        row.push_back(louse.flight_vz);
        break;
      case Column::kDistance:
        row.push_back(louse.distance);
        break;
    }
  }
  return row;
}

}  // namespace woodlouse::server::test
