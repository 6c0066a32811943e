// The kinds of field that a recording's lines are made of; what is missing or wrong is reported, and a
// fallback returned.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/protocol/messages.h"

namespace woodlouse::replay {

inline constexpr std::uint64_t kMaxTick = std::uint64_t{1}
                                          << 53;  ///< exact as a double; 4.7 million years at 60 Hz

inline constexpr std::uint64_t kMaxOffset = std::uint64_t{1} << 53;  ///< [bytes]

std::uint64_t demand_integer(const json::Fields& fields, std::string_view key, std::uint64_t min,
                             std::uint64_t max, json::Problems& problems);

/// Text for people: bounded, otherwise as it was said.
std::string text_of(const json::Value& value, json::Problems& problems);
std::string demand_text(const json::Fields& fields, std::string_view key, json::Problems& problems);

/// player, bot or spectator.
protocol::Role role_of(const json::Value& value, json::Problems& problems);

/// 16 lower-case hex digits.
std::uint64_t demand_hash(const json::Fields& fields, std::string_view key, json::Problems& problems);

/// A whole text as an unsigned number of that base.
std::optional<std::uint64_t> unsigned_text(std::string_view text, int base);

}  // namespace woodlouse::replay
