#include "server/proxies/proxy_doorway.h"

#include <poll.h>
#include <sys/socket.h>

#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>

#include <array>
#include <cassert>
#include <cerrno>
#include <string_view>
#include <utility>

namespace woodlouse::server {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using Verdict = ProxyHeader::Verdict;

ProxyDoorway::ProxyDoorway(tcp::socket socket, Timekeeper& timekeeper, Duration patience)
    : lane_(socket.get_executor()),
      socket_(std::move(socket)),
      timekeeper_(timekeeper),
      patience_(patience),
      alarm_(timekeeper.make_alarm(lane_)) {
  assert(patience > Duration{});
}

void ProxyDoorway::start(Done done) {
  assert(done);
  asio::dispatch(lane_, [self = shared_from_this(), done = std::move(done)]() mutable {
    assert(!self->done_);
    self->done_ = std::move(done);
    self->alarm_->set(self->timekeeper_.now() + self->patience_, [self](bool cancelled) {
      if (!cancelled) self->give_up();
    });
    self->wait();
  });
}

void ProxyDoorway::end() {
  asio::post(lane_, [self = shared_from_this()] { self->give_up(); });
}

void ProxyDoorway::wait() {
  socket_.async_wait(tcp::socket::wait_read,
                     [self = shared_from_this()](const error_code& error) { self->look(error); });
}

void ProxyDoorway::look(const error_code& error) {
  if (!done_) return;
  if (error) return finish({});
  std::array<char, ProxyHeader::kMostBytes> bytes{};
  const ssize_t size = ::recv(socket_.native_handle(), bytes.data(), bytes.size(), MSG_PEEK | MSG_DONTWAIT);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return wait();
  if (size <= 0) return finish({});  // whoever takes over sees the end, too
  const auto came = static_cast<std::size_t>(size);
  ProxyHeader header = ProxyHeader::read({bytes.data(), came});
  if (header.verdict == Verdict::kMore) {
    if (came < wanted_ && has_ended()) return give_up();
    want(header.bytes);
    return wait();
  }
  if (header.verdict == Verdict::kWhole) {
    const ssize_t taken = ::recv(socket_.native_handle(), bytes.data(), header.bytes, MSG_DONTWAIT);
    assert(taken == static_cast<ssize_t>(header.bytes));  // nobody else reads
    static_cast<void>(taken);
  }
  finish(std::move(header));
}

/// Woken at so many bytes: those that are there would wake us again and again.
void ProxyDoorway::want(std::size_t bytes) {
  wanted_ = bytes;
  error_code ignored;  // then it is looked at too often
  socket_.set_option(asio::socket_base::receive_low_watermark(static_cast<int>(bytes)), ignored);
}

bool ProxyDoorway::has_ended() {
  pollfd waits{socket_.native_handle(), POLLRDHUP, 0};
  return ::poll(&waits, 1, 0) == 1 && (waits.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

/// Part of a header is none that anybody could go on from.
void ProxyDoorway::give_up() {
  if (!done_) return;
  if (wanted_ > 1) return finish({Verdict::kRefused, 0, std::nullopt, "it was cut off"});
  finish({});
}

void ProxyDoorway::finish(ProxyHeader header) {
  assert(header.verdict != Verdict::kMore);
  alarm_->cancel();
  if (wanted_ > 1) want(1);
  error_code ignored;  // nothing waits any more, then
  socket_.cancel(ignored);
  std::exchange(done_, nullptr)(std::move(header), std::move(socket_));
}

}  // namespace woodlouse::server
