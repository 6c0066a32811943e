// The columns of a row: the one list of what a frame can say of a louse. Units, quanta: docs/protocol.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "shared/state/louse_fields.h"

namespace woodlouse::protocol {

/// A column of a row; the names on the wire are to_text()'s. See docs/protocol.md for units and quanta.
enum class Column : std::uint8_t {
  kId,
  kX,
  kY,
  kVx,
  kVy,
  kZ,
  kHeadingX,
  kHeadingY,
  kYaw,
  kPitch,
  kRoll,
  kSpeed,
  kTx,
  kTy,
  kThrustKind,
  kTicksLeft,
  kPhase,
  kFlightZ,
  kFlightVz,
  kDistance,
  // Of the rules of play; 0 where a mode has none.
  kScore,     ///< points; of a race the best run [moments]
  kGate,      ///< the next one
  kLap,       ///< of the run, from 0
  kLapStart,  ///< [moments]; 0: the clock does not run
  kBestLap,   ///< [moments]; 0: none
};
inline constexpr std::size_t kColumnCount = 25;

std::string_view to_text(Column column);
std::optional<Column> column_from_text(std::string_view text);
/// Quantized rows carry integers, multiples of this; 1 for id, thrust_kind, ticks_left, phase.
double quantum(Column column);
/// The field of a louse that the column shows, or null where it is computed from the louse and the terrain.
const state::LouseField* louse_field(Column column);

/// One that counts: an integer in either format.
bool is_whole(Column column);
/// One of the rules of play.
constexpr bool is_of_rules(Column column) { return column >= Column::kScore; }

inline constexpr std::array kRulesColumns = {Column::kScore, Column::kGate, Column::kLap, Column::kLapStart,
                                             Column::kBestLap};

/// `id x y vx vy`, what a row has unless asked otherwise.
const std::vector<Column>& default_columns();
/// `all`: a louse's fields in their order, from which the state hash can be recomputed (exact format).
const std::vector<Column>& all_columns();

}  // namespace woodlouse::protocol
