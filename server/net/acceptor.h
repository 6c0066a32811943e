// The server's ports: turns connections into sessions and keeps them until they are closed. On one port the
// server speaks first, on the other, the web's, the client does (doorway.h).
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "server/logging/events.h"
#include "server/net/connection_limits.h"
#include "server/net/doorway.h"
#include "server/net/http_door.h"
#include "server/net/listen_address.h"
#include "server/net/port.h"
#include "server/net/session.h"
#include "server/net/tls_context.h"
#include "server/net/web_names.h"
#include "server/proxies/proxy_doorway.h"
#include "server/proxies/trusted_proxies.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class Acceptor {
 public:
  /// All outlive it.
  Acceptor(const Lanes& lanes, const SessionEnvironment& environment);

  // Listen. Before the threads run.
  /// trusted: who may say, on either port, for whom a connection or a request is.
  core::Expected<boost::asio::ip::tcp::endpoint> open(const ListenAddress& address,
                                                      TrustedProxies trusted = {});
  /// After open().
  core::Expected<boost::asio::ip::tcp::endpoint> open_web(const WebSettings& settings);

  // Any thread:
  void start();
  /// Reads certificate and key again, for who comes from now on. REQUIRES that there are some. If they can't
  /// be used the old ones serve on, and the log says why, too.
  core::Expected<void> reread(const WebSettings& settings);
  /// Ends those; `done` is called on some thread: how many sessions that were.
  using IsMeant = std::function<bool(SessionId session, const std::string& address)>;
  void expel(IsMeant is_meant, protocol::ErrorMessage why, std::function<void(std::size_t)> done);
  /// The address that each session is counted by; `told` is called on some thread.
  void ask_addresses(std::function<void(std::map<SessionId, std::string>)> told);
  /// Closes the ports, says bye to who is left; `stopped` when the last connection is closed.
  void stop(protocol::Bye bye, std::function<void()> stopped);

 private:
  /// Somebody who was let in.
  struct Guest {
    SessionId id = 0;
    std::string address;  ///< ConnectionLimits::key()
    std::size_t lane = 0;
    std::optional<protocol::ErrorMessage> refusal;  ///< why he must go again
    bool is_confidential = true;                    ///< nobody on the way reads what he says
    /// A trusted proxy that has not said for whom this is, or may say so anew with each request. Till it has
    /// said so, `address` is a key of its own for those that are not known.
    std::optional<boost::asio::ip::address> proxy{};
    bool is_web = false;  ///< his session's wire is a WebSocket
  };
  /// One of whom it is not known yet whether a session comes of him.
  struct Visit {
    Guest guest;
    std::function<void()> end;
    bool is_http = false;  ///< counted as such
  };

  /// Nobody where it was too many even to be told.
  std::optional<Guest> admit(boost::asio::ip::tcp::socket& socket, std::size_t lane);
  /// Where a connection goes on once it is known whose it is.
  using Onwards = void (Acceptor::*)(boost::asio::ip::tcp::socket socket, Guest guest);
  /// `onwards` with whom it lets in; before that what a trusted proxy says.
  void let_in(boost::asio::ip::tcp::socket socket, std::size_t lane, Duration patience, Onwards onwards);
  void on_proxy_header(SessionId id, const ProxyHeader& header, boost::asio::ip::tcp::socket socket,
                       Onwards onwards);
  /// The connection is of that address from now on.
  void settle(Guest& guest, const boost::asio::ip::address& of);
  /// A request came through a trusted proxy.
  HttpDoor::Asker on_forwarded(SessionId id, const std::string& forwarded);
  HttpDoor::Asker take_http(Visit& visit);
  void greet(boost::asio::ip::tcp::socket socket, Guest guest);
  void meet(boost::asio::ip::tcp::socket socket, Guest guest);
  void on_first_byte(SessionId id, Comes what, boost::asio::ip::tcp::socket socket);
  void shake_hands(SessionId id, boost::asio::ip::tcp::socket socket);
  void on_first_byte_inside(SessionId id, Comes what, std::unique_ptr<TlsConnection> connection);
  /// Connection: as make_http_door() takes them.
  template <typename Connection>
  void open_http_door(SessionId id, Connection connection);
  void on_upgraded(SessionId id, std::unique_ptr<Wire> wire);
  /// It is known now what came of it.
  Guest take_visit(SessionId id);
  void open_session(std::unique_ptr<Wire> wire, Guest guest, Session::Greeting greeting);
  void end_visit(SessionId id);
  void on_closed(const Guest& guest);
  void count_sessions(const Guest& guest, bool is_new);
  void tell_when_empty() {
    if (stopped_ && sessions_.empty() && visits_.empty()) std::exchange(stopped_, nullptr)();
  }
  void log(LogEvent event, const std::string& address, const std::string& what);

  const Lanes& lanes_;
  const SessionEnvironment& environment_;
  Port::Strand strand_;
  Port lines_;
  Port web_;
  WebEnvironment web_environment_;
  TrustedProxies trusted_;
  std::shared_ptr<boost::asio::ssl::context>
      tls_;  ///< null: TLS is not spoken; once the threads run the strand's
  // The strand's:
  ConnectionLimits addresses_;
  std::unordered_map<SessionId, std::shared_ptr<Session>> sessions_;
  std::unordered_map<SessionId, Visit> visits_;
  SessionId next_id_ = 1;
  bool is_stopping_ = false;
  std::function<void()> stopped_;
};

}  // namespace woodlouse::server
