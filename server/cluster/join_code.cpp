#include "server/cluster/join_code.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <set>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"

namespace woodlouse::server {
namespace {

/// No vowel, so that no word comes of them; of those that look or sound alike one.
constexpr std::string_view kLetters = "BCDFGHJKMPRSTVXZ";
constexpr unsigned kBitsOfLetter = 4;
static_assert(kLetters.size() == 1u << kBitsOfLetter);

std::string code_of(std::string_view cluster, const RoomName& name, std::uint64_t attempt) {
  const std::string_view end("\0", 1);  // stands in no name
  std::uint64_t bits = core::stable_hash(
      core::joined({cluster, end, name.shard, end, name.room, end, std::to_string(attempt)}));
  std::string code;
  for (std::size_t k = 0; k < kJoinCodeLetters; ++k, bits >>= kBitsOfLetter)
    code += kLetters[bits % kLetters.size()];
  return code;
}

}  // namespace

std::vector<std::string> join_codes(std::string_view cluster, const std::vector<RoomName>& rooms) {
  std::vector<std::size_t> order(rooms.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&rooms](auto a, auto b) { return rooms[a] < rooms[b]; });
  std::vector<std::string> codes(rooms.size());
  std::set<std::string> taken;
  for (const std::size_t place : order)
    for (std::uint64_t attempt = 0; codes[place].empty(); ++attempt) {
      assert(attempt <= rooms.size());  // some are free: there are a million
      std::string code = code_of(cluster, rooms[place], attempt);
      if (taken.insert(code).second) codes[place] = std::move(code);
    }
  return codes;
}

std::optional<std::string> typed_join_code(std::string_view text) {
  if (text.size() != kJoinCodeLetters) return std::nullopt;
  std::string code(text);
  for (char& letter : code)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  const bool is_one = std::all_of(code.begin(), code.end(),
                                  [](char c) { return kLetters.find(c) != std::string_view::npos; });
  return is_one ? std::optional(code) : std::nullopt;
}

}  // namespace woodlouse::server
