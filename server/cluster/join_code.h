// The codes by which rooms are joined besides their names: five letters that are easy to say and to type. A
// code follows from the names alone, so that every host of a cluster tells the same without a word. It is no
// secret. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace woodlouse::server {

inline constexpr std::size_t kJoinCodeLetters = 5;

struct RoomName {
  std::string shard;  ///< empty: of no cluster
  std::string room;
  friend auto operator<=>(const RoomName&, const RoomName&) = default;
};

/// Of each of these rooms, which are all that there are, in their order. Of two rooms that would have one
/// code, which of a few hundred rooms one set in twenty has, the first by name keeps it, and the other one
/// has its next.
[[nodiscard]] std::vector<std::string> join_codes(std::string_view cluster,
                                                  const std::vector<RoomName>& rooms);

/// As it is told, of one that somebody typed: capital letters. Nothing: it is none.
[[nodiscard]] std::optional<std::string> typed_join_code(std::string_view text);

}  // namespace woodlouse::server
