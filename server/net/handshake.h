// Which message is legal when: the rules of a session, without its socket.
//
//   greeting --join--> joined (player, bot or spectator) --leave--> leaving
//       ^----refused by the room----'
// Pure. One owner, no locking.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/protocol/codec.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

class Handshake {
 public:
  enum class State { kGreeting, kPlaying, kSpectating, kLeaving };

  /// How many lines running may be no JSON at all before it is hopeless.
  static constexpr int kMaxStrikes = 3;

  /// A message has come. Legal: nothing. Else the error to answer. REQUIRES that it is not leaving.
  std::optional<protocol::ErrorMessage> why_not(const protocol::ClientMessage& message);
  /// A legal message is taken: the state moves on.
  void take(const protocol::ClientMessage& message);
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

/// What a session is told of the other servers at which the rooms may be found: of many the first kMaxHosts.
/// `Source`: those there are now, whatever order they come in; null: none ever.
class HostNews {
 public:
  using Source = std::function<std::vector<std::string>()>;
  std::vector<std::string> now(const Source& source);
  /// Nothing: those that were told are all there, and there are no more that could be told.
  std::optional<std::vector<std::string>> since(const Source& source);

 private:
  std::vector<std::string> tell(std::vector<std::string> hosts);

  std::vector<std::string> told_;
};

/// What a session is told first of all. session: its number, for logs. hosts: `host:port` of other servers
/// that may have the rooms when this one is gone, kMaxHosts at most.
protocol::Hello hello_of(std::uint64_t session, std::string_view server, std::vector<std::string> rooms,
                         const protocol::Limits& limits, std::vector<std::string> hosts);
/// What a line that begins an HTTP request is told besides: where a browser is to go. Empty for other lines.
/// web_url: of this server's page; empty: it has none.
std::string where_http_is(std::string_view line, std::string_view web_url);
/// The answer to a join of a room that is at another server, `host:port`. The connection ends with it.
protocol::ErrorMessage room_moved(const std::string& asked, std::string address);
/// The answer to a join of a room that is not among those.
protocol::ErrorMessage unknown_room(const std::string& asked, const std::vector<std::string>& rooms);
/// The answer to who would moderate and may not.
protocol::ErrorMessage no_moderator();

}  // namespace woodlouse::server
