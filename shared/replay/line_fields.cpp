#include "shared/replay/line_fields.h"

#include <string>

namespace woodlouse::replay {
namespace {

/// A whole number counts quanta; one with a point stands as itself.
double read_component(const json::Value& value, json::Problems& problems) {
  constexpr json::Range kUnit{-1.0, 1.0, ""};
  constexpr json::Range kQuanta{-128.0, 128.0, "/ 128"};
  if (value.is(json::Kind::kInteger)) {
    const double quanta = json::number_in(value, kQuanta, problems).value_or(0.0);
    return (quanta == 0.0 ? 0.0 : quanta) * state::kThrustQuantum;
  }
  return json::number_in(value, kUnit, problems).value_or(0.0);
}

}  // namespace

void read_thrust(const json::Value& value, match::AppliedInput& input, json::Problems& problems) {
  if (value.is(json::Kind::kNull)) return;
  if (!value.is(json::Kind::kArray)) {
    input.kind = state::ThrustKind::kAlongHeading;
    input.thrust.x = read_component(value, problems);
    return;
  }
  const std::vector<json::Value> pair = value.children();
  if (pair.size() != 2) return problems.add(value, "a pair [x, y] is wanted");
  input.kind = state::ThrustKind::kMapVector;
  input.thrust = {read_component(pair[0], problems), read_component(pair[1], problems)};
  if (core::dot(input.thrust, input.thrust) > 1.0) problems.add(value, "is longer than 1");
}

match::PlayerLabel label_of(const json::Value& name, const json::Value& role, json::Problems& problems) {
  const std::optional<state::Role> known =
      protocol::role_from_text(json::any_text(role, kMaxTextBytes, problems));
  const bool plays = known && *known != state::Role::kSpectator;
  if (!plays) problems.add(role, "is no role of who plays", "player or bot");
  return {json::any_text(name, kMaxTextBytes, problems), plays ? *known : state::Role::kPlayer};
}

std::string bytes_of(const json::Value& value, json::Problems& problems) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  const std::string_view text = value.is(json::Kind::kString) ? value.text() : std::string_view();
  std::string bytes;
  for (std::size_t k = 0; k + 1 < text.size() && digit(text[k]) >= 0 && digit(text[k + 1]) >= 0; k += 2)
    bytes += static_cast<char>(digit(text[k]) << 4 | digit(text[k + 1]));
  if (text.empty() || 2 * bytes.size() != text.size())
    problems.add(value, "bytes of two hex digits each are wanted");
  return bytes;
}

}  // namespace woodlouse::replay
