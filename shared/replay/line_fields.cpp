#include "shared/replay/line_fields.h"

#include <string>

namespace woodlouse::replay {

protocol::Role role_of(const json::Value& value, json::Problems& problems) {
  const std::string text = json::any_text(value, kMaxTextBytes, problems);
  const std::optional<protocol::Role> role = protocol::role_from_text(text);
  if (!role) problems.add(value, "is no role", "player, bot or spectator");
  return role.value_or(protocol::Role::kPlayer);
}

}  // namespace woodlouse::replay
