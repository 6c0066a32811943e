#include "server/net/tls_doorway.h"

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "server/net/tls_wire.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

class SslDoorway final : public TlsDoorway, public std::enable_shared_from_this<SslDoorway> {
 public:
  SslDoorway(tcp::socket socket, asio::ssl::context& context, Timekeeper& timekeeper)
      : lane_(socket.get_executor()),
        connection_(std::make_unique<TlsConnection>(
            TlsConnection{asio::ssl::stream<tcp::socket>(std::move(socket), context), {}})),
        timekeeper_(timekeeper),
        alarm_(timekeeper.make_alarm(lane_)) {}

  void start(Done done) override {
    assert(done);
    asio::dispatch(lane_, [self = shared_from_this(), done = std::move(done)]() mutable {
      assert(!self->done_);
      self->done_ = std::move(done);
      self->shake_hands();
    });
  }
  void end() override {
    asio::post(lane_, [self = shared_from_this()] { self->give_up(); });
  }

 private:
  void shake_hands() {
    alarm_->set(timekeeper_.now() + Doorway::kPatience, [self = shared_from_this()](bool cancelled) {
      if (!cancelled) self->give_up();
    });
    connection_->stream.async_handshake(
        asio::ssl::stream_base::server,
        [self = shared_from_this()](const error_code& error) { self->on_handshake(error); });
  }

  void on_handshake(const error_code& error) {
    if (error || is_given_up_) return finish(Comes::kNothing);
    connection_->stream.async_read_some(
        asio::buffer(first_), [self = shared_from_this()](const error_code& failed, std::size_t size) {
          self->on_first(failed, size);
        });
  }

  void on_first(const error_code& error, std::size_t size) {
    if (error || size == 0 || is_given_up_) return finish(Comes::kNothing);
    assert(size <= first_.size());
    connection_->first.assign(first_.data(), size);
    const Comes what = what_comes(static_cast<unsigned char>(first_[0]));
    finish(what == Comes::kTls ? Comes::kNothing : what);
  }

  /// What runs ends by it, and calls finish().
  void give_up() {
    if (!done_) return;
    is_given_up_ = true;
    error_code ignored;  // closed all the same
    connection_->stream.lowest_layer().close(ignored);
  }

  void finish(Comes what) {
    assert(done_);
    alarm_->cancel();
    if (what == Comes::kNothing) connection_ = nullptr;
    std::exchange(done_, nullptr)(what, std::move(connection_));
  }

  asio::any_io_executor lane_;
  std::unique_ptr<TlsConnection> connection_;
  Timekeeper& timekeeper_;
  std::unique_ptr<Alarm> alarm_;
  Done done_;  ///< empty once it was called
  bool is_given_up_ = false;
  std::array<char, 512> first_{};
};

}  // namespace

std::shared_ptr<TlsDoorway> make_tls_doorway(tcp::socket socket, asio::ssl::context& context,
                                             Timekeeper& timekeeper) {
  return std::make_shared<SslDoorway>(std::move(socket), context, timekeeper);
}

}  // namespace woodlouse::server
