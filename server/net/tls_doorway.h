// The handshake of TLS, and what is spoken inside it: as at a doorway (doorway.h), by the first byte. Within
// TLS nothing can be looked at and left where it is: what was read comes along.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include <functional>
#include <memory>

#include "server/net/doorway.h"
#include "server/timing/timekeeper.h"

namespace boost::asio::ssl {
class context;
}

namespace woodlouse::server {

struct TlsConnection;

class TlsDoorway {
 public:
  /// Called once, on the socket's lane. kNothing, also for TLS inside of TLS: the connection is null.
  using Done = std::function<void(Comes what, std::unique_ptr<TlsConnection> connection)>;

  TlsDoorway() = default;
  TlsDoorway(const TlsDoorway&) = delete;
  TlsDoorway& operator=(const TlsDoorway&) = delete;
  virtual ~TlsDoorway() = default;

  // Any thread:
  virtual void start(Done done) = 0;
  /// Waits no longer: nothing comes.
  virtual void end() = 0;
};

/// The socket's executor is a lane; nothing of what came was read. timekeeper outlives it. Handshake and
/// first byte have Doorway::kPatience together.
std::shared_ptr<TlsDoorway> make_tls_doorway(boost::asio::ip::tcp::socket socket,
                                             boost::asio::ssl::context& context, Timekeeper& timekeeper);

}  // namespace woodlouse::server
