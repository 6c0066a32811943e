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

/// What a row shows besides the louse itself.
struct Ground {
  terrain::SurfaceSample sample;
  physics::Attitude attitude;
};

bool is_of_the_attitude(Column column) {
  return column == Column::kYaw || column == Column::kPitch || column == Column::kRoll;
}

double ground_value(Column column, const state::Louse& louse, const Ground& ground) {
  switch (column) {
    case Column::kZ:
      return louse.phase == state::Phase::kFlying ? louse.flight_z : ground.sample.z;
    case Column::kYaw:
      return ground.attitude.yaw;
    case Column::kPitch:
      return ground.attitude.pitch;
    case Column::kRoll:
      return ground.attitude.roll;
    case Column::kSpeed: {
      const double vz = state::vertical_speed(louse, {ground.sample.zx, ground.sample.zy});
      return std::sqrt(core::dot(louse.velocity, louse.velocity) + vz * vz);
    }
    default:
      assert(false && "a louse's own field");
      return 0.0;
  }
}

}  // namespace

RowTable::RowTable(RowLayout layout) : layout_(std::move(layout)) {
  assert(!layout_.fields.empty() && layout_.fields.size() <= protocol::kColumnCount);
  for (const Column column : layout_.fields) own_fields_.push_back(protocol::louse_field(column));
  needs_ground_ = std::find(own_fields_.begin(), own_fields_.end(), nullptr) != own_fields_.end();
  needs_attitude_ = std::any_of(layout_.fields.begin(), layout_.fields.end(), is_of_the_attitude);
}

void RowTable::append(std::string& out, const state::Louse& louse, const terrain::Terrain& terrain) const {
  Ground ground;
  if (needs_ground_) {
    ground.sample = terrain.sample(louse.position.x, louse.position.y);
    if (needs_attitude_)
      ground.attitude = physics::attitude(louse.heading, {ground.sample.zx, ground.sample.zy});
  }
  constexpr std::size_t kSeparator = 1;
  char row[protocol::kColumnCount * (kSeparator + protocol::kValueRoom) + kSeparator];
  char* end = row;
  for (std::size_t k = 0; k < layout_.fields.size(); ++k) {
    const Column column = layout_.fields[k];
    const state::LouseField* own = own_fields_[k];
    const double value =
        own != nullptr ? state::field_value(louse, *own) : ground_value(column, louse, ground);
    *end++ = ',';
    end = protocol::write_value(end, value, column, layout_.format);
  }
  row[0] = '[';
  *end++ = ']';
  out.append(row, end);
}

}  // namespace woodlouse::server
