#include "server/net/http_door.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/stream_traits.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/verb.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include <array>
#include <cassert>
#include <string_view>
#include <type_traits>
#include <utility>

#include "server/net/http_response.h"
#include "server/net/tls_wire.h"
#include "server/net/web_wire.h"
#include "server/web/web_answers.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;

constexpr std::size_t kBufferBytes = 2 * std::size_t{HttpDoor::kHeadBytes};  // of a head and what comes along

constexpr std::size_t kKeyLength = 24;  // of Sec-WebSocket-Key: 16 bytes in base64

constexpr std::size_t kLineEnd = 2;  // "\r\n", which may stand at a message's end

/// What is refused of a head that could not be read. Nothing: the connection is broken or at its end.
std::optional<WebAnswer> refusal_of(const error_code& error, bool may_ask) {
  if (error == http::error::end_of_stream || error == http::error::partial_message) return std::nullopt;
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return refusal(431, "the request's head is longer than 8192 bytes");
  if (error == http::error::body_limit)
    return may_ask ? refusal(413, "a request has no body here")
                   : refusal(405, "only GET and HEAD are answered");
  if (error == http::error::bad_version) return refusal(505, "HTTP/1.1 is spoken here");
  if (error.category() == http::make_error_code(http::error::bad_method).category())
    return refusal(400, "that is no HTTP request");
  return std::nullopt;
}

/// Those that look after the server are told, however much others of their address ask.
bool is_probe(std::string_view target) { return target == "/healthz" || target == "/readyz"; }

/// Stream: a socket, or TLS on one.
template <typename Stream>
class StreamHttpDoor final : public HttpDoor, public std::enable_shared_from_this<StreamHttpDoor<Stream>> {
 public:
  StreamHttpDoor(Stream stream, std::string_view first, const SessionEnvironment& environment,
                 const WebEnvironment& web, Asker asker, Ends ends)
      : lane_(stream.get_executor()),
        stream_(std::move(stream)),
        environment_(environment),
        web_(web),
        asker_(std::move(asker)),
        ends_(std::move(ends)),
        alarm_(environment.timekeeper.make_alarm(lane_)) {
    assert(asker_.account != nullptr && ends_.closed && ends_.upgraded);
    buffer_.commit(asio::buffer_copy(buffer_.prepare(first.size()), asio::buffer(first)));
  }

  void start() override {
    asio::dispatch(lane_, [self = this->shared_from_this()] { self->read_head(); });
  }
  void end() override {
    asio::post(lane_, [self = this->shared_from_this()] {
      self->is_stopping_ = true;
      if (!self->is_answering_) return self->close();
      self->end_at(self->now() + Session::kShutdownLinger);
    });
  }

 private:
  static constexpr bool kIsSecure = !std::is_same_v<Stream, asio::ip::tcp::socket>;

  [[nodiscard]] asio::ip::tcp::socket& socket() { return beast::get_lowest_layer(stream_); }
  void read_head();
  void on_head(const error_code& error);
  [[nodiscard]] std::string forwarded() const;
  void answer_request();
  [[nodiscard]] WebAnswer judge();
  [[nodiscard]] std::string why_no_upgrade();
  void upgrade();
  void answer(WebAnswer answer, bool is_last);
  void on_answered(const error_code& error);
  void shut_down();
  void drain();
  void close();
  /// It ends then, if nothing else is set before.
  void end_at(Time until) {
    until_ = until;
    alarm_->set(until, [self = this->shared_from_this()](bool cancelled) {
      if (!cancelled && self->now() >= self->until_) self->close();
    });
  }
  [[nodiscard]] Time now() const { return environment_.timekeeper.now(); }
  [[nodiscard]] std::string_view field(http::field name) const {
    const auto value = parser_->get()[name];
    return {value.data(), value.size()};
  }
  [[nodiscard]] std::string_view target() const {
    const auto value = parser_->get().target();
    return {value.data(), value.size()};
  }
  [[nodiscard]] bool may_ask() const {
    const http::verb method = parser_->get().method();
    return method == http::verb::get || method == http::verb::head;
  }

  asio::any_io_executor lane_;
  Stream stream_;
  const SessionEnvironment& environment_;
  const WebEnvironment& web_;
  Asker asker_;
  Ends ends_;  ///< empty once one was called

  std::unique_ptr<Alarm> alarm_;
  Time until_{};
  beast::flat_buffer buffer_{kBufferBytes};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::uint32_t requests_ = 0;
  WebAnswer answer_;  ///< whose bytes response_ has
  HttpResponse response_;
  std::optional<http::response_serializer<HttpResponse::body_type>> serializer_;
  bool is_answering_ = false;
  bool is_last_ = false;  ///< of the answer that is written
  bool is_stopping_ = false;
  std::array<char, 512> thrown_away_{};
};

template <typename Stream>
void StreamHttpDoor<Stream>::read_head() {
  if (!ends_.closed) return;
  parser_.emplace();
  parser_->header_limit(kHeadBytes);
  parser_->body_limit(0);
  end_at(now() + kPatience);
  http::async_read_header(
      stream_, buffer_, *parser_,
      [self = this->shared_from_this()](const error_code& error, std::size_t) { self->on_head(error); });
}

template <typename Stream>
void StreamHttpDoor<Stream>::on_head(const error_code& error) {
  if (!ends_.closed) return;
  ++requests_;
  if (error) {
    auto refused = refusal_of(error, may_ask());
    return refused ? answer(std::move(*refused), true) : close();
  }
  if (!parser_->is_done()) {  // a body comes, which nobody reads
    return answer(may_ask() ? refusal(413, "a request has no body here")
                            : refusal(405, "only GET and HEAD are answered"),
                  true);
  }
  if (!ends_.who) return answer_request();
  // Until it is known for whom it is nothing is read.
  ends_.who(forwarded(), [self = this->shared_from_this()](Asker asker) {
    asio::post(self->lane_, [self, asker = std::move(asker)]() mutable {
      if (!self->ends_.closed) return;
      self->asker_ = std::move(asker);
      self->answer_request();
    });
  });
}

/// All that stands in X-Forwarded-For, of which each proxy has added one or the other.
template <typename Stream>
std::string StreamHttpDoor<Stream>::forwarded() const {
  std::string all;
  const auto [begin, end] = parser_->get().equal_range("X-Forwarded-For");
  for (auto field = begin; field != end; ++field) {
    const auto value = field->value();
    all.append(all.empty() ? "" : ",").append(value.data(), value.size());
  }
  return all;
}

template <typename Stream>
void StreamHttpDoor<Stream>::answer_request() {
  WebAnswer answered = judge();
  if (answered.status == 101) return upgrade();
  const bool is_refused = answered.status >= 400 && answered.status != 404;
  const bool is_last =
      !parser_->get().keep_alive() || requests_ >= kMostRequests || is_stopping_ || is_refused;
  answer(std::move(answered), is_last);
}

/// 101: a session may begin.
template <typename Stream>
WebAnswer StreamHttpDoor<Stream>::judge() {
  if (!asker_.refusal.empty()) return refusal(503, asker_.refusal);
  const http::request<http::empty_body>& request = parser_->get();
  if (request.count(http::field::host) != 1) return refusal(400, "a request names one Host");
  const std::string_view host = field(http::field::host);
  if (const std::string why = why_not_host(host, web_.names); !why.empty()) return refusal(403, why);
  if (!may_ask()) return refusal(405, "only GET and HEAD are answered");
  if (!is_probe(target()) && asker_.account->wait(Spending::kAnswerBytes, now()) > Duration{})
    return refusal(429, "your address has asked for too much; try again in a second");
  if (target().substr(0, target().find('?')) == "/ws") {
    if (!beast::websocket::is_upgrade(request))
      return refusal(426, "here WebSockets begin: ask for an upgrade");
    if (field(http::field::sec_websocket_key).size() != kKeyLength)
      return refusal(400, "a WebSocket's key is 16 bytes in base64");
    const std::string why = why_no_upgrade();
    return why.empty() ? WebAnswer{.status = 101} : refusal(403, why);
  }
  const auto authority = parse_authority(host);
  assert(authority.has_value());
  WebAnswer answered = answer_to(
      {target(), authority->host, field(http::field::accept_encoding), field(http::field::if_none_match)},
      environment_.directory,
      {environment_.server_name, web_.lines_port,
       is_stopping_ || (environment_.doorman != nullptr && environment_.doorman->is_draining()),
       web_.pages.get()},
      now());
  asker_.account->charge(Spending::kAnswerBytes, static_cast<double>(answered.content().size()), now());
  return answered;
}

template <typename Stream>
std::string StreamHttpDoor<Stream>::why_no_upgrade() {
  const std::size_t origins = parser_->get().count(http::field::origin);
  if (buffer_.size() > 0) return "wait for the answer before you send";
  if (is_stopping_) return "the server stops";
  if (origins == 0) return {};  // no browser
  if (origins > 1) return "a page has one Origin";
  return why_not_origin(field(http::field::origin), kIsSecure, field(http::field::host), web_.names);
}

template <typename Stream>
void StreamHttpDoor<Stream>::upgrade() {
  alarm_->cancel();
  environment_.traffic.answer(101);
  auto upgraded = [ends = std::exchange(ends_, {})](std::unique_ptr<Wire> wire) {
    if (wire == nullptr) return ends.closed();
    ends.upgraded(std::move(wire));
  };
  accept_web_wire(std::move(stream_), parser_->get(), environment_.limits.now()->line + kLineEnd,
                  std::move(upgraded));
}

template <typename Stream>
void StreamHttpDoor<Stream>::answer(WebAnswer answer, bool is_last) {
  assert(!is_answering_ && answer.status >= 200);
  environment_.traffic.answer(answer.status);
  is_answering_ = true;
  is_last_ = is_last;
  answer_ = std::move(answer);
  response_ = make_response(answer_, !is_last);
  serializer_.emplace(response_);
  end_at(now() + kPatience + std::chrono::seconds(answer_.content().size() / kSlowest));
  auto answered = [self = this->shared_from_this()](const error_code& error, std::size_t) {
    self->on_answered(error);
  };
  if (parser_->get().method() == http::verb::head)
    http::async_write_header(stream_, *serializer_, std::move(answered));
  else
    http::async_write(stream_, *serializer_, std::move(answered));
}

template <typename Stream>
void StreamHttpDoor<Stream>::on_answered(const error_code& error) {
  if (!ends_.closed) return;
  is_answering_ = false;
  if (error) return close();
  if (!is_last_ && !is_stopping_) return read_head();
  if (!is_stopping_) end_at(now() + kLinger);  // else end() has said till when
  if constexpr (kIsSecure)
    stream_.async_shutdown([self = this->shared_from_this()](const error_code&) { self->shut_down(); });
  else
    shut_down();
}

template <typename Stream>
void StreamHttpDoor<Stream>::shut_down() {
  if (!ends_.closed) return;
  error_code ignored;  // then he has gone
  socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  drain();
}

/// What he still says is thrown away: closing with unread bytes would take the answer with it.
template <typename Stream>
void StreamHttpDoor<Stream>::drain() {
  socket().async_read_some(asio::buffer(thrown_away_),
                           [self = this->shared_from_this()](const error_code& error, std::size_t) {
                             if (!self->ends_.closed) return;
                             error ? self->close() : self->drain();
                           });
}

template <typename Stream>
void StreamHttpDoor<Stream>::close() {
  if (!ends_.closed) return;
  alarm_->cancel();
  error_code ignored;  // closed all the same
  socket().close(ignored);
  std::exchange(ends_, {}).closed();
}

}  // namespace

core::Expected<void> WebEnvironment::use(const WebSettings& settings) {
  auto chosen = chosen_pages(settings.root);
  if (!chosen) return tl::unexpected(chosen.error());
  names = settings.names;
  pages = std::move(*chosen);
  return {};
}

std::shared_ptr<HttpDoor> make_http_door(asio::ip::tcp::socket socket, const SessionEnvironment& environment,
                                         const WebEnvironment& web, HttpDoor::Asker asker,
                                         HttpDoor::Ends ends) {
  return std::make_shared<StreamHttpDoor<asio::ip::tcp::socket>>(std::move(socket), "", environment, web,
                                                                 std::move(asker), std::move(ends));
}

std::shared_ptr<HttpDoor> make_http_door(std::unique_ptr<TlsConnection> connection,
                                         const SessionEnvironment& environment, const WebEnvironment& web,
                                         HttpDoor::Asker asker, HttpDoor::Ends ends) {
  assert(connection != nullptr);
  return std::make_shared<StreamHttpDoor<decltype(TlsConnection::stream)>>(
      std::move(connection->stream), connection->first, environment, web, std::move(asker), std::move(ends));
}

}  // namespace woodlouse::server
