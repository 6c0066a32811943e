#include "shared/replay/line_fields.h"

#include <charconv>
#include <system_error>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"

namespace woodlouse::replay {
namespace {

constexpr std::size_t kMaxTextBytes = 4096;

}  // namespace

std::uint64_t demand_integer(const json::Fields& fields, std::string_view key, std::uint64_t min,
                             std::uint64_t max, json::Problems& problems) {
  const auto value = fields.demand(key);
  return value ? json::integer_in(*value, min, max, problems).value_or(min) : min;
}

std::string text_of(const json::Value& value, json::Problems& problems) {
  if (value.is(json::Kind::kString) && value.text().size() <= kMaxTextBytes) return std::string(value.text());
  problems.add(value, core::joined({"text of at most ", std::to_string(kMaxTextBytes), " bytes is wanted"}));
  return {};
}

std::string demand_text(const json::Fields& fields, std::string_view key, json::Problems& problems) {
  const auto value = fields.demand(key);
  return value ? text_of(*value, problems) : std::string();
}

protocol::Role role_of(const json::Value& value, json::Problems& problems) {
  const std::string text = text_of(value, problems);
  for (const protocol::Role known :
       {protocol::Role::kPlayer, protocol::Role::kBot, protocol::Role::kSpectator}) {
    if (protocol::to_text(known) == text) return known;
  }
  problems.add(value, "is no role", "player, bot or spectator");
  return protocol::Role::kPlayer;
}

std::optional<std::uint64_t> unsigned_text(std::string_view text, int base) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::uint64_t demand_hash(const json::Fields& fields, std::string_view key, json::Problems& problems) {
  const auto value = fields.demand(key);
  if (!value) return 0;
  const std::string_view text = value->is(json::Kind::kString) ? value->text() : std::string_view();
  const auto hash = text.size() == 16 ? unsigned_text(text, 16) : std::nullopt;
  if (hash && core::to_hex(*hash) == text) return *hash;
  problems.add(*value, "16 lower-case hex digits are wanted");
  return 0;
}

}  // namespace woodlouse::replay
