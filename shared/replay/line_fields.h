// What the fields of a recording's lines may be, besides what json/fields.h knows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shared/json/fields.h"
#include "shared/match/match_state.h"
#include "shared/protocol/messages.h"

namespace woodlouse::replay {

inline constexpr std::uint64_t kMaxTick = std::uint64_t{1}
                                          << 53;  ///< exact as a double; 4.7 million years at 60 Hz

inline constexpr std::uint64_t kMaxOffset = std::uint64_t{1} << 53;  ///< [bytes]
inline constexpr std::size_t kMaxTextBytes = 4096;                   ///< of a text for people

/// Of a player or a bot; another role is reported.
match::PlayerLabel label_of(const json::Value& name, const json::Value& role, json::Problems& problems);

/// A thrust as recordings name it, into an input's kind and value: a number along the heading, a pair, or
/// null.
void read_thrust(const json::Value& value, match::AppliedInput& input, json::Problems& problems);

/// Calls read(element) for each element of a list; stops at the first problem, of which one is enough.
template <typename Read>
void read_list(const json::Value& value, json::Problems& problems, const Read& read) {
  if (!value.is(json::Kind::kArray)) return problems.add(value, "a list is wanted");
  for (const json::Value& element : value.children()) {
    if (problems.count() != 0) return;
    read(element);
  }
}

/// A text of two hex digits a byte, at least one byte.
std::string bytes_of(const json::Value& value, json::Problems& problems);

}  // namespace woodlouse::replay
