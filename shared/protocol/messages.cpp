#include "shared/protocol/messages.h"

#include <cassert>

namespace woodlouse::protocol {
namespace {

struct ColumnEntry {
  std::string_view name;
  double quantum;
};

// In the order of Column. Powers of two, so that multiplying by them is exact.
constexpr std::array<ColumnEntry, kColumnCount> kColumns = {{
    {"id", 1.0},
    {"x", 0x1p-10},
    {"y", 0x1p-10},
    {"vx", 0x1p-10},
    {"vy", 0x1p-10},
    {"z", 0x1p-10},
    {"heading_x", 0x1p-10},
    {"heading_y", 0x1p-10},
    {"yaw", 0x1p-10},
    {"pitch", 0x1p-10},
    {"roll", 0x1p-10},
    {"speed", 0x1p-10},
    {"tx", state::kThrustQuantum},
    {"ty", state::kThrustQuantum},
    {"thrust_kind", 1.0},
    {"ticks_left", 1.0},
    {"phase", 1.0},
    {"flight_z", 0x1p-10},
    {"flight_vz", 0x1p-10},
    {"distance", 0x1p-7},
}};

const ColumnEntry& entry(Column column) {
  const auto index = static_cast<std::size_t>(column);
  assert(index < kColumns.size());
  return kColumns[index];
}

}  // namespace

std::string_view to_text(Column column) { return entry(column).name; }

std::optional<Column> column_from_text(std::string_view text) {
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    if (kColumns[i].name == text) return static_cast<Column>(i);
  }
  return std::nullopt;
}

double quantum(Column column) { return entry(column).quantum; }

const std::vector<Column>& default_columns() {
  static const std::vector<Column> columns = {Column::kId, Column::kX, Column::kY, Column::kVx, Column::kVy};
  return columns;
}

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns = {
      Column::kId,      Column::kPhase,    Column::kX,        Column::kY,          Column::kVx,
      Column::kVy,      Column::kHeadingX, Column::kHeadingY, Column::kTx,         Column::kTy,
      Column::kFlightZ, Column::kFlightVz, Column::kDistance, Column::kThrustKind, Column::kTicksLeft};
  return columns;
}

std::string_view to_text(Format format) { return format == Format::kExact ? "exact" : "quantized"; }

std::string_view to_text(Role role) {
  switch (role) {
    case Role::kPlayer:
      return "player";
    case Role::kBot:
      return "bot";
    case Role::kSpectator:
      return "spectator";
  }
  return "player";
}

std::string_view to_text(EventKind kind) {
  switch (kind) {
    case EventKind::kJoined:
      return "joined";
    case EventKind::kLeft:
      return "left";
    case EventKind::kChat:
      return "chat";
    case EventKind::kRespawned:
      return "respawned";
  }
  return "joined";
}

}  // namespace woodlouse::protocol
