#include "server/net/doorway.h"

#include <sys/socket.h>

#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>

#include <cassert>
#include <cerrno>
#include <utility>

namespace woodlouse::server {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

Comes what_comes(unsigned char byte) {
  constexpr unsigned char kTlsHandshake = 0x16;
  if (byte == '{' || byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n') return Comes::kLines;
  if (byte >= 'A' && byte <= 'Z') return Comes::kHttp;
  return byte == kTlsHandshake ? Comes::kTls : Comes::kNothing;
}

Doorway::Doorway(tcp::socket socket, Timekeeper& timekeeper)
    : lane_(socket.get_executor()),
      socket_(std::move(socket)),
      timekeeper_(timekeeper),
      alarm_(timekeeper.make_alarm(lane_)) {}

void Doorway::start(Done done) {
  assert(done);
  asio::dispatch(lane_, [self = shared_from_this(), done = std::move(done)]() mutable {
    assert(!self->done_);
    self->done_ = std::move(done);
    self->alarm_->set(self->timekeeper_.now() + kPatience, [self](bool cancelled) {
      if (!cancelled) self->finish(Comes::kNothing);
    });
    self->wait();
  });
}

void Doorway::end() {
  asio::post(lane_, [self = shared_from_this()] { self->finish(Comes::kNothing); });
}

void Doorway::wait() {
  socket_.async_wait(tcp::socket::wait_read,
                     [self = shared_from_this()](const error_code& error) { self->look(error); });
}

void Doorway::look(const error_code& error) {
  if (!done_) return;
  if (error) return finish(Comes::kNothing);
  unsigned char first = 0;
  const ssize_t size = ::recv(socket_.native_handle(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return wait();
  finish(size == 1 ? what_comes(first) : Comes::kNothing);
}

void Doorway::finish(Comes what) {
  if (!done_) return;
  alarm_->cancel();
  if (what == Comes::kNothing) {
    error_code ignored;  // closed all the same
    socket_.close(ignored);
  }
  std::exchange(done_, nullptr)(what, std::move(socket_));
}

}  // namespace woodlouse::server
