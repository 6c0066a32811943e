// A socket on which HTTP is spoken: one request after the other is answered, GET and HEAD alone, until one of
// them asks for a WebSocket (web_wire.h). Who asks for what is not here, asks slowly or says too much is told
// so, where he can be, and goes; nothing else stays behind.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/net/address_account.h"
#include "server/net/session.h"
#include "server/net/web_names.h"
#include "server/net/wire.h"
#include "server/web/page_files.h"

namespace woodlouse::server {

/// What all HTTP sockets share, besides what sessions do; outlives them.
struct WebEnvironment {
  WebNames names;
  std::uint16_t lines_port = 0;              ///< where the server speaks first
  std::unique_ptr<const PageFiles> pages{};  ///< null: there is no page

  /// Errors: the page's folder can't be opened.
  core::Expected<void> use(const WebSettings& settings);
};

struct TlsConnection;

class HttpDoor {
 public:
  static constexpr Duration kPatience = std::chrono::seconds(10);  ///< for a head, and for an answer
  static constexpr std::size_t kSlowest =
      16384;  ///< [bytes/s] a long answer has longer, read as slowly as this
  static constexpr Duration kLinger = std::chrono::seconds(1);  ///< for what is not read, after the last
  static constexpr std::uint32_t kHeadBytes = 8192;
  static constexpr std::uint32_t kMostRequests = 100;

  /// Who asks.
  struct Asker {
    std::shared_ptr<AddressAccount> account;
    std::string refusal;  ///< why he is refused; empty: he is answered
  };
  using Known = std::function<void(Asker asker)>;

  /// One of the first two is called, once, on the socket's lane.
  struct Ends {
    std::function<void()> closed;
    std::function<void(std::unique_ptr<Wire> wire)> upgraded;  ///< a session may begin on it
    /// Where requests come through a trusted proxy: asked on the lane for whom each is, by what stands in its
    /// X-Forwarded-For; calls known once, on any thread. Empty: all are whose the socket is.
    std::function<void(std::string forwarded, Known known)> who{};
  };

  HttpDoor() = default;
  HttpDoor(const HttpDoor&) = delete;
  HttpDoor& operator=(const HttpDoor&) = delete;
  virtual ~HttpDoor() = default;

  // Any thread:
  virtual void start() = 0;
  /// The server stops: what is being answered is the last, and has as long as a session's bye.
  virtual void end() = 0;
};

/// The socket's executor is a lane; nothing of what came was read. asker: whose requests they are.
std::shared_ptr<HttpDoor> make_http_door(boost::asio::ip::tcp::socket socket,
                                         const SessionEnvironment& environment, const WebEnvironment& web,
                                         HttpDoor::Asker asker, HttpDoor::Ends ends);
/// The same after the handshake of TLS.
std::shared_ptr<HttpDoor> make_http_door(std::unique_ptr<TlsConnection> connection,
                                         const SessionEnvironment& environment, const WebEnvironment& web,
                                         HttpDoor::Asker asker, HttpDoor::Ends ends);

}  // namespace woodlouse::server
