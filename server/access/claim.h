// Who may come back to a louse, as others than his own room may know it: by a digest of his token, from which
// nobody makes the token.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "server/access/resume_token.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Of 256 bits. A token is 128 random bits: its digest needs no salt, and no list finds it.
using TokenDigest = std::array<std::uint64_t, 4>;

/// SHA-256 of the token as the wire has it.
TokenDigest digest_of(const ResumeToken& token);

/// Of a mute that ends with its louse alone.
inline constexpr std::uint64_t kMutedForGood = std::uint64_t{1} << 62;

struct Claim {
  match::PlayerId louse = 0;
  std::string name;
  protocol::Role role = protocol::Role::kPlayer;
  TokenDigest token{};
  std::uint64_t muted_until = 0;  ///< by an operator, wherever the room goes on [Unix s]; 0: he is not
  friend bool operator==(const Claim&, const Claim&) = default;
};

}  // namespace woodlouse::server
