#include "server/net/web_wire.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/stream_traits.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;

constexpr std::chrono::seconds kAcceptWithin{10};
// From a close frame of ours to the end of the connection; sessions linger as long.
constexpr std::chrono::seconds kCloseWithin{1};
// Pings and pongs of the WebSocket's own pass by what a session counts. Each batch that goes out makes up for
// a few, so that who is shown a game may ping as often as he likes, and nobody without end.
constexpr std::uint32_t kMostControls = 256;
constexpr std::uint32_t kControlsABatch = 8;

/// What goes on for a moment when its wire has gone, where the end is still being said: TLS does not stand
/// that it is gone then.
template <typename Stream>
struct WebLink {
  explicit WebLink(Stream stream) : socket(std::move(stream)) {
    socket.control_callback([this](websocket::frame_type kind, beast::string_view) { on_control(kind); });
  }
  WebLink(const WebLink&) = delete;
  WebLink& operator=(const WebLink&) = delete;

  error_code close() {
    error_code error;
    beast::get_lowest_layer(socket).close(error);
    return error;
  }
  void on_control(websocket::frame_type kind) {
    if (kind == websocket::frame_type::close) {
      // Beast answers, then waits for the other side's end, and writes nothing else till then: a client that
      // has closed but for its socket would hold its place. So nothing more comes in.
      error_code ignored;  // then it has gone
      beast::get_lowest_layer(socket).shutdown(asio::ip::tcp::socket::shutdown_receive, ignored);
    } else if (++controls > kMostControls) {
      static_cast<void>(close());
    }
  }

  websocket::stream<Stream, false> socket;
  std::uint32_t controls = 0;  ///< that nothing which went out made up for
};

/// Without compression: a batch is packed for each client anew, and shared buffers would be shared no more.
template <typename Stream>
class WebWire final : public Wire {
 public:
  WebWire(Stream stream, std::size_t longest) : link_(std::make_shared<WebLink<Stream>>(std::move(stream))) {
    use_patience(kAcceptWithin);
    link_->socket.set_option(websocket::stream_base::decorator(
        [](websocket::response_type& response) { response.set(beast::http::field::server, "woodlouse"); }));
    link_->socket.auto_fragment(false);
    link_->socket.text(true);
    link_->socket.read_message_max(longest);
  }

  template <typename Accepted>
  void accept(const beast::http::request<beast::http::empty_body>& request, Accepted accepted) {
    link_->socket.async_accept(request, std::move(accepted));
  }

  /// For a handshake, also for that of the end. None for silence: sessions have their own.
  void use_patience(std::chrono::seconds patience) {
    link_->socket.set_option(
        websocket::stream_base::timeout{patience, websocket::stream_base::none(), false});
  }

  void read_some(std::span<char> into, Handler handler) override {
    assert(into.size() > 1);
    // The newline that ends the message as a line finds its place behind it.
    link_->socket.async_read_some(
        asio::buffer(into.data(), into.size() - 1),
        [this, into, handler = std::move(handler)](const error_code& error, std::size_t size) {
          on_read(into, handler, error, size);
        });
  }

  /// Beast writes its answers to pings and closes in turns with what we write.
  [[nodiscard]] std::size_t write_now(std::span<const Line>) override { return 0; }

  void write(std::span<const Line> lines, std::size_t skipped, Handler handler) override {
    assert(!lines.empty() && skipped == 0);
    static_cast<void>(skipped);
    // Beast closes it, for a broken frame: it would write again when the other side has ended, too.
    if (!link_->socket.is_open()) {
      asio::post(link_->socket.get_executor(),
                 [handler = std::move(handler)] { handler(asio::error::operation_aborted, 0); });
      return;
    }
    link_->controls -= std::min(link_->controls, kControlsABatch);
    buffers_.clear();
    for (const Line& line : lines) buffers_.push_back(asio::buffer(*line));
    link_->socket.async_write(std::span<const asio::const_buffer>(buffers_), std::move(handler));
  }

  /// With the code for a normal end, whatever it was: the bye before it says why.
  [[nodiscard]] error_code shut_down_sending() override {
    if (!link_->socket.is_open()) return asio::error::not_connected;
    link_->socket.async_close({websocket::close_code::normal}, [kept = link_](const error_code&) {});
    return {};
  }

  [[nodiscard]] error_code close() override { return link_->close(); }

 private:
  void on_read(std::span<char> into, const Handler& handler, const error_code& error, std::size_t size) {
    if (error == websocket::error::closed) return handler(asio::error::eof, 0);
    if (error) return handler(error, 0);
    if (!link_->socket.got_text()) {
      link_->socket.async_close({websocket::close_code::unknown_data},
                                [handler](const error_code&) { handler(asio::error::eof, 0); });
      return;
    }
    assert(size < into.size());
    if (size > 0) last_byte_ = into[size - 1];
    if (link_->socket.is_message_done() && std::exchange(last_byte_, '\0') != '\n') into[size++] = '\n';
    if (size == 0) return read_some(into, handler);  // an empty part
    handler({}, size);
  }

  std::shared_ptr<WebLink<Stream>> link_;
  std::vector<asio::const_buffer> buffers_;  ///< of the write that runs
  char last_byte_ = '\0';                    ///< of the message that comes
};

template <typename Stream>
void accept_on(Stream stream, const beast::http::request<beast::http::empty_body>& request,
               std::size_t longest, std::function<void(std::unique_ptr<Wire> wire)> accepted) {
  assert(longest > 0 && accepted);
  auto wire = std::make_unique<WebWire<Stream>>(std::move(stream), longest);
  WebWire<Stream>& accepting = *wire;
  accepting.accept(request,
                   [wire = std::move(wire), accepted = std::move(accepted)](const error_code& error) mutable {
                     if (error) return accepted(nullptr);
                     wire->use_patience(kCloseWithin);
                     accepted(std::move(wire));
                   });
}

}  // namespace

void accept_web_wire(asio::ip::tcp::socket socket,
                     const beast::http::request<beast::http::empty_body>& request, std::size_t longest,
                     std::function<void(std::unique_ptr<Wire> wire)> accepted) {
  accept_on(std::move(socket), request, longest, std::move(accepted));
}

void accept_web_wire(decltype(TlsConnection::stream) stream,
                     const beast::http::request<beast::http::empty_body>& request, std::size_t longest,
                     std::function<void(std::unique_ptr<Wire> wire)> accepted) {
  accept_on(std::move(stream), request, longest, std::move(accepted));
}

}  // namespace woodlouse::server
