// Which message is legal when: the rules of a session, without its socket.
//
//   greeting --join--> joined (player, bot or spectator) --leave--> leaving
//       ^----refused by the room----'
// Pure. One owner, no locking.
#pragma once

#include <cstdint>
#include <optional>

#include "shared/protocol/codec.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

class Handshake {
 public:
  enum class State { kGreeting, kPlaying, kSpectating, kLeaving };

  /// How many lines running may be no JSON at all before it is hopeless.
  static constexpr int kMaxStrikes = 3;

  /// A message has come. Legal: nothing, and the state moves on. Else the error to answer. REQUIRES that it
  /// is not leaving.
  std::optional<protocol::ErrorMessage> judge(const protocol::ClientMessage& message);
  /// A line could not be read. The error to answer; fatal when it was the kMaxStrikes-th running that is no
  /// JSON, or a join of another protocol version.
  protocol::ErrorMessage judge(const protocol::DecodeError& error);
  /// The room did not take the join: the client may try another.
  void refused() { state_ = State::kGreeting; }

  [[nodiscard]] State state() const { return state_; }

 private:
  State state_ = State::kGreeting;
  int strikes_ = 0;
};

}  // namespace woodlouse::server
