#include "server/net/web_wire.h"

#include <boost/asio/associated_executor.hpp>
#include <boost/asio/bind_executor.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/stream_traits.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
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

/// What a WebSocket reads from and writes to. Beast writes its own frames through it, answers to pings and
/// closes; the wire writes batches past Beast, which would copy nothing, but hold each up by turns of its
/// own: in frames of ours, each whole before another begins.
template <typename Next>
class SharedStream {
 public:
  using next_layer_type = Next;
  using executor_type = typename Next::executor_type;

  explicit SharedStream(Next next) : next_(std::move(next)) {}

  executor_type get_executor() noexcept { return next_.get_executor(); }
  [[nodiscard]] Next& next_layer() { return next_; }
  [[nodiscard]] const Next& next_layer() const { return next_; }
  /// A frame may begin at once.
  [[nodiscard]] bool is_free() const { return !is_beast_writing_ && !is_wire_writing_; }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    next_.async_read_some(buffers, std::forward<Handler>(handler));
  }
  /// Beast's. It goes on with what is left of a frame within the handler: no frame of ours comes between.
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    assert(!is_beast_writing_ && !beast_waits_);
    if (!is_wire_writing_) return write_for_beast(buffers, std::forward<Handler>(handler));
    const auto kept = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
    beast_waits_ = [this, buffers, kept] { write_for_beast(buffers, std::move(*kept)); };
  }
  /// All of the buffers, which the caller keeps until the handler is called.
  void write_all(std::span<const asio::const_buffer> buffers, Wire::Handler handler) {
    assert(!is_wire_writing_ && !wire_waits_);
    if (!is_beast_writing_) return write_for_wire(buffers, std::move(handler));
    wire_waits_ = [this, buffers, handler = std::move(handler)] { write_for_wire(buffers, handler); };
  }

 private:
  template <typename Buffers, typename Handler>
  void write_for_beast(const Buffers& buffers, Handler&& handler) {
    is_beast_writing_ = true;
    const auto executor = asio::get_associated_executor(handler, get_executor());
    next_.async_write_some(
        buffers, asio::bind_executor(executor, [this, handler = std::forward<Handler>(handler)](
                                                   const error_code& error, std::size_t size) mutable {
          is_beast_writing_ = false;
          handler(error, size);
          if (!is_beast_writing_ && wire_waits_) std::exchange(wire_waits_, nullptr)();
        }));
  }
  void write_for_wire(std::span<const asio::const_buffer> buffers, Wire::Handler handler) {
    is_wire_writing_ = true;
    asio::async_write(next_, buffers,
                      [this, handler = std::move(handler)](const error_code& error, std::size_t size) {
                        is_wire_writing_ = false;
                        if (beast_waits_) std::exchange(beast_waits_, nullptr)();
                        handler(error, size);
                      });
  }

  Next next_;
  bool is_beast_writing_ = false;
  bool is_wire_writing_ = false;
  std::function<void()> beast_waits_, wire_waits_;  ///< for the other's frame
};

template <typename Next>
void teardown(beast::role_type role, SharedStream<Next>& stream, error_code& error) {
  using websocket::teardown;
  teardown(role, stream.next_layer(), error);
}
template <typename Next, typename Handler>
void async_teardown(beast::role_type role, SharedStream<Next>& stream, Handler&& handler) {
  using websocket::async_teardown;
  async_teardown(role, stream.next_layer(), std::forward<Handler>(handler));
}

/// The head of a frame (RFC 6455, 5.2) of text, whole, from a server.
class FrameHead {
 public:
  void begin(std::size_t payload) {
    bytes_[0] = '\x81';
    const int length = payload < 126 ? 0 : payload <= 0xffff ? 2 : 8;
    bytes_[1] = static_cast<char>(length == 0 ? payload : length == 2 ? 126 : 127);
    for (int k = 0; k < length; ++k)
      bytes_[static_cast<std::size_t>(2 + k)] = static_cast<char>((payload >> (8 * (length - 1 - k))) & 0xff);
    size_ = static_cast<std::size_t>(2 + length);
  }
  [[nodiscard]] asio::const_buffer buffer() const { return asio::buffer(bytes_.data(), size_); }

 private:
  std::array<char, 10> bytes_{};
  std::size_t size_ = 0;
};

/// What goes on for a moment when its wire has gone, where the end is still being said: TLS does not stand
/// that it is gone then.
template <typename Stream>
struct WebLink {
  explicit WebLink(Stream stream) : socket(SharedStream<Stream>(std::move(stream))) {
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

  websocket::stream<SharedStream<Stream>, false> socket;
  std::uint32_t controls = 0;  ///< that nothing which went out made up for
  bool is_closing = false;     ///< Beast has been asked to: it bears to be asked once
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

  /// What is encrypted can't be taken back where the system has no room for it: over TLS nothing.
  [[nodiscard]] std::size_t write_now(std::span<const Line> lines) override {
    assert(!lines.empty() && head_sent_ == 0);
    if constexpr (std::is_same_v<Stream, asio::ip::tcp::socket>) {
      SharedStream<Stream>& shared = link_->socket.next_layer();
      if (!link_->socket.is_open() || !shared.is_free() || !shared.next_layer().non_blocking()) return 0;
      const std::size_t whole = begin_frame(lines);
      error_code error;
      const std::size_t sent =
          shared.next_layer().write_some(std::span<const asio::const_buffer>(buffers_), error);
      if (error) return 0;
      const std::size_t of_head = std::min(sent, head_.buffer().size());
      head_sent_ = sent == whole ? 0 : of_head;
      return sent - of_head;
    } else {
      return 0;
    }
  }

  void write(std::span<const Line> lines, std::size_t skipped, Handler handler) override {
    assert(!lines.empty() && (skipped == 0 || head_sent_ == head_.buffer().size()));
    // Beast closes it, for a broken frame: it would write again when the other side has ended, too.
    if (!link_->socket.is_open()) {
      asio::post(link_->socket.get_executor(),
                 [handler = std::move(handler)] { handler(asio::error::operation_aborted, 0); });
      return;
    }
    begin_frame(lines);
    for (std::size_t past = std::exchange(head_sent_, 0) + skipped; asio::const_buffer & buffer : buffers_) {
      const std::size_t gone = std::min(past, buffer.size());
      buffer += gone;
      past -= gone;
    }
    link_->socket.next_layer().write_all(buffers_, std::move(handler));
  }

  /// With the code for a normal end, whatever it was: the bye before it says why.
  [[nodiscard]] error_code shut_down_sending() override {
    if (!link_->socket.is_open()) return asio::error::not_connected;
    if (std::exchange(link_->is_closing, true)) return {};
    link_->socket.async_close({websocket::close_code::normal}, [kept = link_](const error_code&) {});
    return {};
  }

  [[nodiscard]] error_code close() override { return link_->close(); }

 private:
  /// Into buffers_; its bytes.
  std::size_t begin_frame(std::span<const Line> lines) {
    link_->controls -= std::min(link_->controls, kControlsABatch);
    std::size_t payload = 0;
    buffers_.assign(1, {});
    for (const Line& line : lines) {
      payload += line->size();
      buffers_.push_back(asio::buffer(*line));
    }
    head_.begin(payload);
    buffers_[0] = head_.buffer();
    return buffers_[0].size() + payload;
  }

  void on_read(std::span<char> into, const Handler& handler, const error_code& error, std::size_t size) {
    if (error == websocket::error::closed) return handler(asio::error::eof, 0);
    if (error) return handler(error, 0);
    if (!link_->socket.got_text()) {
      if (std::exchange(link_->is_closing, true))
        return read_some(into, handler);  // till the other side ends
      link_->socket.async_close({websocket::close_code::unknown_data},
                                [handler](const error_code&) { handler(asio::error::eof, 0); });
      return;
    }
    assert(size < into.size());
    if (size > 0) last_byte_ = into[size - 1];
    if (link_->socket.is_message_done() && std::exchange(last_byte_, '\0') != '\n') into[size++] = '\n';
    if (size == 0) {  // an empty part, of which many are no better than pings
      link_->on_control(websocket::frame_type::ping);
      return read_some(into, handler);
    }
    handler({}, size);
  }

  std::shared_ptr<WebLink<Stream>> link_;
  FrameHead head_;
  std::size_t head_sent_ = 0;                ///< of a frame that is not yet all out
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
