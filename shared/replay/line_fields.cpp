#include "shared/replay/line_fields.h"

#include <string>

namespace woodlouse::replay {

match::PlayerLabel label_of(const json::Value& name, const json::Value& role, json::Problems& problems) {
  const std::optional<state::Role> known =
      protocol::role_from_text(json::any_text(role, kMaxTextBytes, problems));
  const bool plays = known && *known != state::Role::kSpectator;
  if (!plays) problems.add(role, "is no role of who plays", "player or bot");
  return {json::any_text(name, kMaxTextBytes, problems), plays ? *known : state::Role::kPlayer};
}

}  // namespace woodlouse::replay
