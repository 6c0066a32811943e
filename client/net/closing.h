// Why a connection to a server ended, and what that means for who wants to play on.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace woodlouse::client {

/// How far an attempt to join came.
enum class Reached : std::uint8_t {
  kNothing,  ///< the name is not known
  kName,     ///< nobody took the connection
  kHost,     ///< somebody did, who is no server of ours, or has not said so
  kServer,   ///< it greeted
};

inline constexpr const char* kConnectionRefused = "connection refused";

struct Closing {
  std::string reason;  ///< for people, one line
  std::string code{};  ///< the server's, of its bye or error; empty: it said nothing, the line broke
  std::optional<std::chrono::milliseconds> retry_after{};  ///< with rate_limited
  Reached reached = Reached::kNothing;
  std::string address{};  ///< with moved: where the room is, as a stranger told it; empty: not told
};

/// Of an end that the server never announces: what answers there can't be talked to.
inline constexpr const char* kNoServerOfOurs = "no_server_of_ours";

/// Whether the same join may succeed a moment later: the line broke, or the server had no room for us just
/// then. Not when it said why it does not want us, or that we are somewhere else.
bool is_passing(const Closing& closing);

/// Whether another server may let us in where this one, tried on the way back, has not.
bool may_be_elsewhere(const Closing& closing);

}  // namespace woodlouse::client
