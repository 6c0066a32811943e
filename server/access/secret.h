// What proves who somebody is: tokens that were agreed on, compared so that the time it takes says nothing.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::server {

inline constexpr std::size_t kLeastSecretBytes = 8;
inline constexpr std::size_t kMostSecretBytes = 256;

/// Keeps a hash of the token alone. Immutable; any thread.
class Secret {
 public:
  using Digest = std::array<unsigned char, 32>;  ///< SHA-256

  explicit Secret(std::string_view token) : digest_(digest_of(token)) {}
  /// To compare one token with several secrets.
  [[nodiscard]] static Digest digest_of(std::string_view token);

  /// In the same time whatever differs, and wherever.
  [[nodiscard]] bool matches(std::string_view token) const { return matches(digest_of(token)); }
  [[nodiscard]] bool matches(const Digest& digest) const;

 private:
  Digest digest_;
};

/// Nothing but visible ASCII, of kLeastSecretBytes to kMostSecretBytes: what can be typed, and told apart.
[[nodiscard]] bool may_be_secret(std::string_view token);

/// Of a file whose first line is the token and that has no other. option: which one names it, for errors,
/// none of which shows what is in the file.
core::Expected<Secret> read_secret(std::string_view option, const std::filesystem::path& file);

}  // namespace woodlouse::server
