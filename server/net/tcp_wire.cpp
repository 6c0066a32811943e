#include "server/net/tcp_wire.h"

#include <boost/asio/write.hpp>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cassert>

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

// What the kernel may hold unsent for one client. Small, so that a client that reads slowly shows soon and
// what it is sent is fresh; bytes on their way do not count, so that distance costs no speed.
using NotSentLowWater = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;
constexpr int kUnsentBytes = 64 * 1024;
using UserTimeout = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;

}  // namespace

error_code set_options(asio::ip::tcp::socket& socket, std::chrono::milliseconds patience) {
  error_code error;
  socket.non_blocking(true, error);
  if (!error) socket.set_option(asio::ip::tcp::no_delay(true), error);
  if (!error) socket.set_option(NotSentLowWater(kUnsentBytes), error);
  if (!error) socket.set_option(UserTimeout(static_cast<int>(patience.count())), error);
  return error;
}

void TcpWire::read_some(std::span<char> into, Handler handler) {
  socket_.async_read_some(asio::buffer(into.data(), into.size()), std::move(handler));
}

void TcpWire::gather(std::span<const Line> lines, std::size_t skipped) {
  buffers_.clear();
  for (const Line& line : lines) {
    const std::size_t gone = std::min(skipped, line->size());
    skipped -= gone;
    if (gone < line->size()) buffers_.push_back(asio::buffer(*line) + gone);
  }
  assert(skipped == 0);
}

std::size_t TcpWire::write_now(std::span<const Line> lines) {
  // Of a frame alone, the usual case: what lets the system look at no list costs half a microsecond less.
  if (lines.size() == 1) {
    const ssize_t sent =
        ::send(socket_.native_handle(), lines[0]->data(), lines[0]->size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    return sent > 0 ? static_cast<std::size_t>(sent) : 0;
  }
  if (!socket_.non_blocking()) return 0;
  gather(lines, 0);
  error_code error;
  const std::size_t written = socket_.write_some(std::span<const asio::const_buffer>(buffers_), error);
  return error ? 0 : written;
}

void TcpWire::write(std::span<const Line> lines, std::size_t skipped, Handler handler) {
  gather(lines, skipped);
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
