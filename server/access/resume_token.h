// The secret by which a player comes back to the louse that waits for it.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "shared/core/stable_hash.h"

namespace woodlouse::server {

/// 128 random bits. Never logged, never told to others. Found by its numbers, so that no time it takes to
/// compare says how much of a guess is right.
using ResumeToken = std::array<std::uint64_t, 2>;

/// From the machine's entropy, as no seed may give it away.
inline ResumeToken make_resume_token() {
  std::random_device device;
  const auto word = [&device] { return (static_cast<std::uint64_t>(device()) << 32) | device(); };
  return {word(), word()};
}

/// As the wire has it: 32 lower-case hex digits.
inline std::string to_text(const ResumeToken& token) {
  return core::to_hex(token[0]) + core::to_hex(token[1]);
}

/// Nothing where it is no such text.
inline std::optional<ResumeToken> resume_token_from(std::string_view text) {
  constexpr std::size_t kDigits = 16;
  ResumeToken token{};
  if (text.size() != kDigits * token.size()) return std::nullopt;
  for (std::size_t k = 0; k < token.size(); ++k) {
    const char* const begin = text.data() + k * kDigits;
    const auto [end, error] = std::from_chars(begin, begin + kDigits, token[k], 16);
    if (error != std::errc() || end != begin + kDigits) return std::nullopt;
  }
  return token;
}

}  // namespace woodlouse::server
