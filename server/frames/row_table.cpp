#include "server/frames/row_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "shared/json/text.h"
#include "shared/physics/attitude.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server {
namespace {

using protocol::Column;

/// What a row shows besides the louse itself.
struct Under {
  const rules::Standing& standing;
  terrain::SurfaceSample sample{};  ///< where a column needs it
  double pitch = 0.0;               ///< the same
};

double computed_value(Column column, const state::Louse& louse, const Under& under) {
  const core::Vec2 gradient{under.sample.zx, under.sample.zy};
  switch (column) {
    case Column::kZ:
      return louse.phase == state::Phase::kFlying ? louse.flight_z : under.sample.z;
    case Column::kYaw:
      return physics::yaw_of(louse.heading);
    case Column::kPitch:
      return under.pitch;
    case Column::kRoll:
      return physics::roll_of(louse.heading, gradient, under.pitch);
    case Column::kSpeed: {
      const double vz = state::vertical_speed(louse, gradient);
      return std::sqrt(core::dot(louse.velocity, louse.velocity) + vz * vz);
    }
    case Column::kScore:
      return static_cast<double>(under.standing.score);
    case Column::kGate:
      return under.standing.gate;
    case Column::kLap:
      return under.standing.lap;
    case Column::kLapStart:
      return static_cast<double>(under.standing.lap_start);
    case Column::kBestLap:
      return static_cast<double>(under.standing.best_lap);
    default:
      assert(false && "a louse's own field");
      return 0.0;
  }
}

}  // namespace

RowTable::RowTable(RowLayout layout) : layout_(std::move(layout)) {
  assert(!layout_.fields.empty() && layout_.fields.size() <= protocol::kColumnCount);
  for (const Column column : layout_.fields)
    cells_.push_back({column, protocol::louse_field(column), 1.0 / protocol::quantum(column)});
  const auto asks_for = [this](Column column) {
    return std::find(layout_.fields.begin(), layout_.fields.end(), column) != layout_.fields.end();
  };
  needs_pitch_ = asks_for(Column::kPitch) || asks_for(Column::kRoll);
  if (asks_for(Column::kZ) || asks_for(Column::kSpeed)) ground_ = Ground::kUnlessFlying;
  if (needs_pitch_) ground_ = Ground::kAlways;
}

template <typename Write>
void RowTable::append_cells(std::string& out, const state::Louse& louse, const rules::Standing& standing,
                            const terrain::Terrain& terrain, const Write& write) const {
  Under under{standing};
  if (ground_ == Ground::kAlways ||
      (ground_ == Ground::kUnlessFlying && louse.phase != state::Phase::kFlying))
    under.sample = terrain.sample(louse.position.x, louse.position.y);
  if (needs_pitch_) under.pitch = physics::pitch_of(louse.heading, {under.sample.zx, under.sample.zy});
  constexpr std::size_t kSeparator = 1;
  char row[protocol::kColumnCount * (kSeparator + protocol::kValueRoom) + kSeparator];
  char* end = row;
  for (const Cell& cell : cells_) {
    const double value = cell.own != nullptr ? state::field_value(louse, *cell.own)
                                             : computed_value(cell.column, louse, under);
    *end++ = ',';
    end = write(end, value, cell);
  }
  row[0] = '[';
  *end++ = ']';
  out.append(row, static_cast<std::size_t>(end - row));
}

void RowTable::append(std::string& out, const state::Louse& louse, const rules::Standing& standing,
                      const terrain::Terrain& terrain) const {
  if (layout_.format == protocol::Format::kExact)
    return append_cells(out, louse, standing, terrain,
                        [](char* to, double value, const Cell&) { return json::write_double(to, value); });
  append_cells(out, louse, standing, terrain, [](char* to, double value, const Cell& cell) {
    return protocol::write_quantized(to, value, cell.per_quantum);
  });
}

}  // namespace woodlouse::server
