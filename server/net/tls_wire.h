// A connection over TLS, on which lines are spoken. Knows OpenSSL: for the files that speak over it alone.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>

#include <memory>
#include <string>

#include "server/net/wire.h"

namespace woodlouse::server {

/// After the handshake.
struct TlsConnection {
  boost::asio::ssl::stream<boost::asio::ip::tcp::socket> stream;
  std::string first;  ///< what the client said already
};

std::unique_ptr<Wire> make_tls_wire(std::unique_ptr<TlsConnection> connection);

}  // namespace woodlouse::server
