#include "shared/replay/step_line.h"

#include <cstdint>
#include <limits>

#include "shared/json/scanner.h"
#include "shared/replay/line_fields.h"
#include "shared/state/thrust.h"

namespace woodlouse::replay {
namespace {

using json::Scanner;

constexpr std::int64_t kMaxUint32 = std::numeric_limits<std::uint32_t>::max();

/// A longer one could have more values than the document's parser would take.
constexpr std::size_t kMaxLineBytes = 1u << 16;

/// A member's key; true where it is that one.
bool take_key(Scanner& scanner, std::string_view key) {
  const auto text = scanner.text();
  return text && *text == key && scanner.take(':');
}

/// Takes an integer into `to`.
template <typename T>
bool take_integer(Scanner& scanner, std::int64_t low, std::int64_t high, T& to) {
  const auto value = scanner.integer(low, high);
  if (value) to = static_cast<T>(*value);
  return value.has_value();
}

/// See read_thrust(); a component with a point is left to it.
bool take_thrust(Scanner& scanner, match::AppliedInput& input) {
  constexpr std::int64_t kUnit = 128;  // quanta
  static_assert(kUnit * state::kThrustQuantum == 1.0);
  if (scanner.take_null()) return true;
  const bool is_pair = scanner.take('[');
  std::int64_t x = 0, y = 0;
  if (!take_integer(scanner, -kUnit, kUnit, x)) return false;
  if (is_pair && !(scanner.take(',') && take_integer(scanner, -kUnit, kUnit, y) && scanner.take(']')))
    return false;
  input.kind = is_pair ? state::ThrustKind::kMapVector : state::ThrustKind::kAlongHeading;
  input.thrust = {static_cast<double>(x) * state::kThrustQuantum,
                  static_cast<double>(y) * state::kThrustQuantum};
  return x * x + y * y <= kUnit * kUnit;
}

/// [player, seq, thrust, margin in ms, ticks], the last two if they are there.
bool take_input(Scanner& scanner, StepLine& line) {
  match::AppliedInput input;
  input.tick = line.step.tick;
  input.ticks = state::kHeld;
  std::optional<std::int64_t> margin;
  const bool begins = scanner.take('[') && take_integer(scanner, 1, kMaxUint32 - 1, input.player) &&
                      scanner.take(',') && take_integer(scanner, 0, kMaxUint32, input.seq) &&
                      scanner.take(',') && take_thrust(scanner, input);
  if (!begins) return false;
  if (scanner.take(',')) {
    if (!scanner.take_null()) {
      margin =
          scanner.integer(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
      if (!margin) return false;
    }
    if (scanner.take(',') && !take_integer(scanner, 0, state::kHeld - 1, input.ticks)) return false;
  }
  line.step.inputs.push_back(input);
  line.margins_ms.push_back(margin);
  return scanner.take(']');
}

}  // namespace

std::optional<StepLine> scan_step(std::string_view text) {
  if (text.size() > kMaxLineBytes) return std::nullopt;
  Scanner scanner(text);
  StepLine line;
  const bool begins = scanner.take('{') && take_key(scanner, "step") &&
                      take_integer(scanner, 0, static_cast<std::int64_t>(kMaxTick), line.step.tick) &&
                      scanner.take(',');
  if (!begins) return std::nullopt;
  auto key = scanner.text();
  if (key && *key == "inputs") {
    constexpr std::size_t kInputBytes = 16;  // of most at least: none of them makes the lists grow
    line.step.inputs.reserve(text.size() / kInputBytes);
    line.margins_ms.reserve(text.size() / kInputBytes);
    if (!scanner.take(':') || !scanner.take('[')) return std::nullopt;
    do {
      if (!take_input(scanner, line)) return std::nullopt;
    } while (scanner.take(','));
    if (!scanner.take(']') || !scanner.take(',')) return std::nullopt;
    key = scanner.text();
  }
  if (!key || *key != "hash" || !scanner.take(':')) return std::nullopt;
  const auto hash = scanner.hash();
  if (!hash || !scanner.take('}') || !scanner.is_at_end()) return std::nullopt;
  line.step.hash = *hash;
  return line;
}

}  // namespace woodlouse::replay
