#include "shared/protocol/columns.h"

#include <cassert>

namespace woodlouse::protocol {
namespace {

struct ColumnEntry {
  std::string_view name;
  double quantum = 0.0;
  const state::LouseField* field = nullptr;  ///< null: computed from the louse and the terrain under it
  bool is_whole = false;
};

/// A column that is one of the louse's own fields.
consteval ColumnEntry own(std::string_view name) {
  const state::LouseField* field = state::find_field(name);
  return {field->name, field->quantum, field, state::holds_integer(*field)};
}

consteval ColumnEntry computed(std::string_view name) { return {name, state::kCoordinateQuantum, nullptr}; }

consteval ColumnEntry counted(std::string_view name) { return {name, 1.0, nullptr, true}; }

// In the order of Column.
constexpr std::array<ColumnEntry, kColumnCount> kColumns = {
    {own("id"),          own("x"),          own("y"),           own("vx"),
     own("vy"),          computed("z"),     own("heading_x"),   own("heading_y"),
     computed("yaw"),    computed("pitch"), computed("roll"),   computed("speed"),
     own("tx"),          own("ty"),         own("thrust_kind"), own("ticks_left"),
     own("phase"),       own("flight_z"),   own("flight_vz"),   own("distance"),
     counted("score"),   counted("gate"),   counted("lap"),     counted("lap_start"),
     counted("best_lap")}};

const ColumnEntry& entry_of(Column column) {
  const auto index = static_cast<std::size_t>(column);
  assert(index < kColumns.size());
  return kColumns[index];
}

}  // namespace

std::string_view to_text(Column column) { return entry_of(column).name; }

std::optional<Column> column_from_text(std::string_view text) {
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    if (kColumns[i].name == text) return static_cast<Column>(i);
  }
  return std::nullopt;
}

bool is_whole(Column column) { return entry_of(column).is_whole; }

double quantum(Column column) { return entry_of(column).quantum; }

const std::vector<Column>& default_columns() {
  static const std::vector<Column> columns = {Column::kId, Column::kX, Column::kY, Column::kVx, Column::kVy};
  return columns;
}

const state::LouseField* louse_field(Column column) { return entry_of(column).field; }

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all;
    for (const state::LouseField& field : state::kLouseFields) {
      const auto column = column_from_text(field.name);
      assert(column && "a louse's field has a column of its name");
      all.push_back(*column);
    }
    return all;
  }();
  return columns;
}

}  // namespace woodlouse::protocol
