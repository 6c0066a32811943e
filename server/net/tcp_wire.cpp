#include "server/net/tcp_wire.h"

#include <boost/asio/write.hpp>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

// What the kernel may hold unsent for one client. Small, so that a client that reads slowly shows soon and
// what it is sent is fresh; bytes on their way do not count, so that distance costs no speed.
using NotSentLowWater = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;
constexpr int kUnsentBytes = 64 * 1024;

}  // namespace

error_code TcpWire::set_options() {
  error_code error;
  socket_.set_option(asio::ip::tcp::no_delay(true), error);
  if (!error) socket_.set_option(NotSentLowWater(kUnsentBytes), error);
  return error;
}

void TcpWire::read_some(std::span<char> into, Handler handler) {
  socket_.async_read_some(asio::buffer(into.data(), into.size()), std::move(handler));
}

void TcpWire::write(std::span<const Line> lines, Handler handler) {
  buffers_.clear();
  for (const Line& line : lines) buffers_.push_back(asio::buffer(*line));
  asio::async_write(socket_, std::span<const asio::const_buffer>(buffers_), std::move(handler));
}

error_code TcpWire::shut_down_sending() {
  error_code error;
  socket_.shutdown(Socket::shutdown_send, error);
  return error;
}

error_code TcpWire::close() {
  error_code error;
  socket_.close(error);
  return error;
}

}  // namespace woodlouse::server
