// A connection over a WebSocket. A message of the client's is a line; a message to it is a batch of whole
// lines, each with its newline, from the shared buffers. Knows Boost.Beast: for http_door.cpp alone.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include <cstddef>
#include <functional>
#include <memory>

#include "server/net/tls_wire.h"
#include "server/net/wire.h"

namespace woodlouse::server {

/// Answers a request for a WebSocket; what was asked for has been found good. longest: bytes of a message
/// from the client. accepted: called once on the socket's executor, a lane; null where the connection broke
/// or the request was none that this WebSocket's version takes.
void accept_web_wire(boost::asio::ip::tcp::socket socket,
                     const boost::beast::http::request<boost::beast::http::empty_body>& request,
                     std::size_t longest, std::function<void(std::unique_ptr<Wire> wire)> accepted);

void accept_web_wire(decltype(TlsConnection::stream) stream,
                     const boost::beast::http::request<boost::beast::http::empty_body>& request,
                     std::size_t longest, std::function<void(std::unique_ptr<Wire> wire)> accepted);

}  // namespace woodlouse::server
