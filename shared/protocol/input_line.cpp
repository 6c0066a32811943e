#include "shared/protocol/input_line.h"

#include <cstdint>
#include <string_view>

#include "shared/json/scanner.h"
#include "shared/protocol/field_reader.h"
#include "shared/state/thrust.h"

namespace woodlouse::protocol {
namespace {

using json::Scanner;

std::optional<state::RoundedThrust> scan_thrust(Scanner& scanner) {
  if (!scanner.is_at('[')) {
    const auto value = scanner.number();
    return value ? std::optional(state::rounded_along_heading(*value)) : std::nullopt;
  }
  scanner.take('[');
  const auto x = scanner.number();
  if (!x || !scanner.take(',')) return std::nullopt;
  const auto y = scanner.number();
  if (!y || !scanner.take(']')) return std::nullopt;
  return state::rounded_map_vector({*x, *y});
}

/// Takes an integer into a field that is still free.
template <typename T>
bool scan_once(Scanner& scanner, std::optional<T>& field, IntegerRange range) {
  if (field) return false;
  const auto value = scanner.integer(range.low, range.high);
  if (value) field = static_cast<T>(*value);
  return value.has_value();
}

}  // namespace

std::optional<Input> scan_input(std::string_view line) {
  Scanner scanner(line);
  bool has_type = false;
  std::optional<std::uint32_t> seq;
  std::optional<state::RoundedThrust> thrust;
  Input input;
  const auto scan_member = [&] {
    const auto key = scanner.text();
    if (!key || !scanner.take(':')) return false;
    if (*key == "seq") return scan_once(scanner, seq, kAnyUint32);
    if (*key == "tick") return scan_once(scanner, input.tick, kAnyTick);
    if (*key == "ticks") return scan_once(scanner, input.ticks, {1, kMaxThrustTicks});
    if (*key == "thrust" && !thrust) return (thrust = scan_thrust(scanner)).has_value();
    if (*key != "type" || has_type) return false;
    const auto type = scanner.text();
    return has_type = type && *type == "input";
  };
  if (!scanner.take('{')) return std::nullopt;
  do {
    if (!scan_member()) return std::nullopt;
  } while (scanner.take(','));
  if (!scanner.take('}') || !scanner.is_at_end() || !has_type || !seq || !thrust) return std::nullopt;
  input.seq = *seq;
  input.thrust = thrust->thrust;
  input.clamped = thrust->clamped;
  return input;
}

}  // namespace woodlouse::protocol
