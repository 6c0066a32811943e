// Recomputes the state hash of keys from their rows, so that a watcher need not believe the server: a bit
// that changed anywhere on the way here, or a server whose picture is not its state, shows at the next key.
// The tick alone is what the key says, where nothing has been done since its link.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "shared/core/stable_hash.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// Whether a client asks for all that a key's hash is made of.
enum class Hashes : std::uint8_t { kIgnored, kVerified };

/// The first key whose hash is not that of its rows.
struct KeyDifference {
  std::uint64_t tick = 0;
  std::uint64_t stated = 0;      ///< what the key says
  std::uint64_t recomputed = 0;  ///< what its rows give
  friend bool operator==(const KeyDifference&, const KeyDifference&) = default;
};

/// One line: the tick and both hashes.
std::string to_text(const KeyDifference& difference);

/// Single thread.
class KeyVerifier {
 public:
  /// Passes over frames that carry no proof.
  void take(const protocol::Frame& frame);

  /// Keys whose hash is that of their rows.
  [[nodiscard]] std::uint64_t verified() const { return verified_; }
  /// Of the newest verified key; 0 before any.
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  [[nodiscard]] const std::optional<KeyDifference>& difference() const { return difference_; }

 private:
  core::StableHasher hasher_;
  std::uint64_t verified_ = 0;
  std::uint64_t hash_ = 0;
  std::optional<KeyDifference> difference_;
};

}  // namespace woodlouse::client
