#include "server/room/row_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "shared/physics/attitude.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server {
namespace {

using protocol::Column;

bool is_of_the_ground(Column column) {
  return column == Column::kZ || column == Column::kYaw || column == Column::kPitch ||
         column == Column::kRoll || column == Column::kSpeed;
}

/// What a row shows besides the louse itself.
struct Ground {
  terrain::SurfaceSample sample;
  physics::Attitude attitude;
};

double value(Column column, const state::Louse& louse, const Ground& ground) {
  switch (column) {
    case Column::kId:
      return louse.id;
    case Column::kX:
      return louse.position.x;
    case Column::kY:
      return louse.position.y;
    case Column::kVx:
      return louse.velocity.x;
    case Column::kVy:
      return louse.velocity.y;
    case Column::kZ:
      return louse.phase == state::Phase::kFlying ? louse.flight_z : ground.sample.z;
    case Column::kHeadingX:
      return louse.heading.x;
    case Column::kHeadingY:
      return louse.heading.y;
    case Column::kYaw:
      return ground.attitude.yaw;
    case Column::kPitch:
      return ground.attitude.pitch;
    case Column::kRoll:
      return ground.attitude.roll;
    case Column::kSpeed: {
      const double vz = louse.phase == state::Phase::kFlying
                            ? louse.flight_vz
                            : ground.sample.zx * louse.velocity.x + ground.sample.zy * louse.velocity.y;
      return std::sqrt(core::dot(louse.velocity, louse.velocity) + vz * vz);
    }
    case Column::kTx:
      return louse.thrust.x;
    case Column::kTy:
      return louse.thrust.y;
    case Column::kThrustKind:
      return static_cast<double>(louse.thrust_kind);
    case Column::kTicksLeft:
      return louse.thrust_ticks;
    case Column::kPhase:
      return static_cast<double>(louse.phase);
    case Column::kFlightZ:
      return louse.flight_z;
    case Column::kFlightVz:
      return louse.flight_vz;
    case Column::kDistance:
      return louse.distance;
  }
  return 0.0;
}

}  // namespace

RowWriter::RowWriter(RowLayout layout) : layout_(std::move(layout)) {
  assert(!layout_.fields.empty() && layout_.fields.size() <= protocol::kColumnCount);
  needs_ground_ = std::any_of(layout_.fields.begin(), layout_.fields.end(), is_of_the_ground);
}

void RowWriter::append(std::string& out, const state::Louse& louse, const terrain::Terrain& terrain) const {
  Ground ground;
  if (needs_ground_) {
    ground.sample = terrain.sample(louse.position.x, louse.position.y);
    ground.attitude = physics::attitude(louse.heading, {ground.sample.zx, ground.sample.zy});
  }
  constexpr std::size_t kSeparator = 1;
  char row[protocol::kColumnCount * (kSeparator + protocol::kMaxValueChars) + kSeparator];
  char* end = row;
  for (const Column column : layout_.fields) {
    *end++ = ',';
    end = protocol::write_value(end, value(column, louse, ground), column, layout_.format);
  }
  row[0] = '[';
  *end++ = ']';
  out.append(row, end);
}

}  // namespace woodlouse::server
