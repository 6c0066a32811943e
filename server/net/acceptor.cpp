#include "server/net/acceptor.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>

#include <cassert>
#include <chrono>
#include <utility>

#include "server/net/admission.h"
#include "server/net/tcp_wire.h"
#include "server/net/tls_doorway.h"
#include "server/net/tls_wire.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

/// Where the server speaks first, who has said nothing by then does not begin with a header.
constexpr Duration kHeaderPatience = std::chrono::seconds(3);

/// As what the connections of a trusted proxy count of which it has not said whose they are.
std::string unknown_of(const asio::ip::address& proxy) { return "proxy " + ConnectionLimits::key(proxy); }

}  // namespace

Acceptor::Acceptor(const Lanes& lanes, const SessionEnvironment& environment)
    : lanes_(lanes),
      environment_(environment),
      strand_(asio::make_strand(lanes.io())),
      lines_(lanes, strand_, environment.log, "--listen", environment.traffic),
      web_(lanes, strand_, environment.log, "--web", environment.traffic),
      addresses_(environment.limits) {}

core::Expected<tcp::endpoint> Acceptor::open(const ListenAddress& address, TrustedProxies trusted) {
  trusted_ = std::move(trusted);
  auto bound = lines_.open(address);
  if (bound) web_environment_.lines_port = bound->port();
  return bound;
}

core::Expected<tcp::endpoint> Acceptor::open_web(const WebSettings& settings) {
  if (const auto used = web_environment_.use(settings); !used) return tl::unexpected(used.error());
  if (settings.tls) {
    auto tls = load_tls(*settings.tls);
    if (!tls) return tl::unexpected(tls.error());
    tls_ = std::move(*tls);
  }
  return web_.open(settings.listen);
}

core::Expected<void> Acceptor::reread(const WebSettings& settings) {
  assert(settings.tls.has_value());
  auto tls = load_tls(*settings.tls);
  if (!tls) {
    log_event(*environment_.log, LogEvent::kCertificateRefused,
              fmt::format("the old certificate serves on: {}: {}", tls.error().where, tls.error().what));
    return tl::unexpected(tls.error());
  }
  asio::post(strand_, [this, fresh = std::move(*tls)]() mutable { tls_ = std::move(fresh); });
  return {};
}

void Acceptor::start() {
  asio::post(strand_, [this] {
    lines_.start([this](tcp::socket socket, std::size_t lane) {
      let_in(std::move(socket), lane, kHeaderPatience, &Acceptor::greet);
    });
    web_.start([this](tcp::socket socket, std::size_t lane) {
      let_in(std::move(socket), lane, Doorway::kPatience, &Acceptor::meet);
    });
  });
}

void Acceptor::let_in(tcp::socket socket, std::size_t lane, Duration patience, Onwards onwards) {
  auto guest = admit(socket, lane);
  if (!guest) return;
  if (!guest->proxy) return (this->*onwards)(std::move(socket), std::move(*guest));
  const SessionId id = guest->id;
  const auto doorway = std::make_shared<ProxyDoorway>(std::move(socket), environment_.timekeeper, patience);
  visits_.emplace(id, Visit{std::move(*guest), [doorway] { doorway->end(); }});
  doorway->start([this, id, onwards](ProxyHeader header, tcp::socket from) {
    asio::post(strand_, [this, id, onwards, header = std::move(header), from = std::move(from)]() mutable {
      on_proxy_header(id, header, std::move(from), onwards);
    });
  });
}

void Acceptor::on_proxy_header(SessionId id, const ProxyHeader& header, tcp::socket socket, Onwards onwards) {
  Guest& guest = visits_.at(id).guest;
  assert(guest.proxy.has_value());
  if (header.verdict == ProxyHeader::Verdict::kRefused)
    log(LogEvent::kProxyHeaderRefused, guest.address,
        "a PROXY header that can't be used: " + header.why + ": closed");
  if (is_stopping_ || header.verdict == ProxyHeader::Verdict::kRefused) return end_visit(id);
  if (header.verdict == ProxyHeader::Verdict::kWhole) {
    settle(guest, header.source.value_or(*guest.proxy));
    const bool is_another_proxy = header.source && trusted_.contains(*header.source);
    guest.proxy = is_another_proxy ? header.source : std::nullopt;
  }
  (this->*onwards)(std::move(socket), take_visit(id));
}

void Acceptor::settle(Guest& guest, const asio::ip::address& of) {
  const std::string address = ConnectionLimits::key(of);
  if (address == guest.address) return;
  const Time now = environment_.timekeeper.now();
  addresses_.release(guest.address, now);
  auto admission = addresses_.admit(address, now);
  if (admission == ConnectionLimits::Admission::kDrop) {
    // It has to be counted as somebody's while he is told.
    addresses_.admit_unknown(guest.address, now);
    admission = ConnectionLimits::Admission::kAddressFull;
  } else {
    guest.address = address;
  }
  guest.refusal = why_turned_away(environment_, admission, of);
  // What is said to a proxy before it comes here nobody knows.
  guest.is_confidential = is_of_this_machine(of);
  log_event(*environment_.log, LogEvent::kConnected,
            fmt::format("session {:016x}: for {}", guest.id, address));
}

void Acceptor::greet(tcp::socket socket, Guest guest) {
  open_session(std::make_unique<TcpWire>(std::move(socket)), std::move(guest), Session::Greeting::kAtOnce);
}

std::optional<Acceptor::Guest> Acceptor::admit(tcp::socket& socket, std::size_t lane) {
  error_code error;
  const tcp::endpoint remote = socket.remote_endpoint(error);
  if (error) return std::nullopt;  // gone before it was seen
  Guest guest{next_id_, ConnectionLimits::key(remote.address()), lane, std::nullopt};
  const Time now = environment_.timekeeper.now();
  guest.is_confidential = is_of_this_machine(remote.address());
  const bool is_proxy = trusted_.contains(remote.address());
  if (is_proxy) {
    guest.proxy = remote.address();
    guest.address = unknown_of(*guest.proxy);
  }
  const auto admission =
      is_proxy ? addresses_.admit_unknown(guest.address, now) : addresses_.admit(guest.address, now);
  TrafficMetrics::add_one(environment_.traffic.connections);
  if (admission == ConnectionLimits::Admission::kDrop) {
    environment_.traffic.refuse(RefusedConnection::kDropped);
    return std::nullopt;
  }
  ++next_id_;
  // Who comes by a proxy is judged when it has said who he is.
  if (!is_proxy) guest.refusal = why_turned_away(environment_, admission, remote.address());
  const auto limits = environment_.limits.now();
  error = set_options(socket, std::chrono::seconds(limits->vacant_s));
  if (error)
    log(LogEvent::kSocketOptionsFailed, guest.address,
        fmt::format("socket options of {}: {}", to_text(remote), error.message()));
  log_event(*environment_.log, LogEvent::kConnected,
            fmt::format("session {:016x}: from {}", guest.id, to_text(remote)));
  return guest;
}

void Acceptor::meet(tcp::socket socket, Guest guest) {
  const SessionId id = guest.id;
  const auto doorway = std::make_shared<Doorway>(std::move(socket), environment_.timekeeper);
  visits_.emplace(id, Visit{std::move(guest), [doorway] { doorway->end(); }});
  doorway->start([this, id](Comes what, tcp::socket from) {
    asio::post(strand_, [this, id, what, from = std::move(from)]() mutable {
      on_first_byte(id, what, std::move(from));
    });
  });
}

void Acceptor::on_first_byte(SessionId id, Comes what, tcp::socket socket) {
  if (is_stopping_ || what == Comes::kNothing) return end_visit(id);
  if (what == Comes::kTls) return shake_hands(id, std::move(socket));
  if (what == Comes::kHttp) return open_http_door(id, std::move(socket));
  open_session(std::make_unique<TcpWire>(std::move(socket)), take_visit(id),
               Session::Greeting::kAfterFirstLine);
}

void Acceptor::shake_hands(SessionId id, tcp::socket socket) {
  Visit& visit = visits_.at(id);
  if (tls_ == nullptr) {
    environment_.traffic.refuse(RefusedConnection::kNoTls);
    log(LogEvent::kTlsRefused, visit.guest.address, "TLS is not spoken here, without --tls-cert: closed");
    return end_visit(id);
  }
  const auto doorway = make_tls_doorway(std::move(socket), *tls_, environment_.timekeeper);
  visit.end = [doorway] { doorway->end(); };
  doorway->start([this, id](Comes what, std::unique_ptr<TlsConnection> connection) {
    asio::post(strand_, [this, id, what, inside = std::move(connection)]() mutable {
      on_first_byte_inside(id, what, std::move(inside));
    });
  });
}

void Acceptor::on_first_byte_inside(SessionId id, Comes what, std::unique_ptr<TlsConnection> connection) {
  if (is_stopping_ || what == Comes::kNothing) return end_visit(id);
  visits_.at(id).guest.is_confidential = true;
  if (what == Comes::kHttp) return open_http_door(id, std::move(connection));
  open_session(make_tls_wire(std::move(connection)), take_visit(id), Session::Greeting::kAfterFirstLine);
}

template <typename Connection>
void Acceptor::open_http_door(SessionId id, Connection connection) {
  Visit& visit = visits_.at(id);
  const bool is_proxy = visit.guest.proxy.has_value();
  HttpDoor::Ends ends{[this, id] { asio::post(strand_, [this, id] { end_visit(id); }); },
                      [this, id](std::unique_ptr<Wire> wire) {
                        asio::post(strand_, [this, id, upgraded = std::move(wire)]() mutable {
                          on_upgraded(id, std::move(upgraded));
                        });
                      }};
  if (is_proxy)
    ends.who = [this, id](std::string forwarded, HttpDoor::Known known) {
      asio::post(strand_, [this, id, forwarded = std::move(forwarded), known = std::move(known)] {
        known(on_forwarded(id, forwarded));
      });
    };
  auto asker = is_proxy ? HttpDoor::Asker{addresses_.account(visit.guest.address), {}} : take_http(visit);
  const auto door = make_http_door(std::move(connection), environment_, web_environment_, std::move(asker),
                                   std::move(ends));
  visit.end = [door] { door->end(); };
  door->start();
}

HttpDoor::Asker Acceptor::on_forwarded(SessionId id, const std::string& forwarded) {
  Visit& visit = visits_.at(id);  // the door says that it is closed later than this
  if (std::exchange(visit.is_http, false)) addresses_.give_http_back(visit.guest.address);
  const auto behind = trusted_.behind(forwarded);
  settle(visit.guest, behind.value_or(*visit.guest.proxy));
  return take_http(visit);
}

/// Whoever's the visit is now speaks HTTP.
HttpDoor::Asker Acceptor::take_http(Visit& visit) {
  assert(!visit.is_http);
  const std::string& address = visit.guest.address;
  visit.is_http = addresses_.take_http(address);
  std::string refusal;
  if (!visit.is_http)
    refusal = "your address has " + std::to_string(ConnectionLimits::kMostHttp) + " of these already";
  if (visit.guest.refusal) refusal = visit.guest.refusal->text;
  return {addresses_.account(address), std::move(refusal)};
}

void Acceptor::on_upgraded(SessionId id, std::unique_ptr<Wire> wire) {
  if (is_stopping_) return end_visit(id);
  Guest guest = take_visit(id);
  guest.is_web = true;
  open_session(std::move(wire), guest, Session::Greeting::kAtOnceOnWeb);
}

Acceptor::Guest Acceptor::take_visit(SessionId id) {
  const auto visit = visits_.find(id);
  assert(visit != visits_.end());
  Guest guest = std::move(visit->second.guest);
  if (visit->second.is_http) addresses_.give_http_back(guest.address);
  visits_.erase(visit);
  return guest;
}

void Acceptor::open_session(std::unique_ptr<Wire> wire, Guest guest, Session::Greeting greeting) {
  // Its proxy never said for whom: then it is its own.
  if (guest.proxy && guest.address == unknown_of(*guest.proxy)) settle(guest, *guest.proxy);
  const auto session = std::make_shared<Session>(guest.id, std::move(wire), lanes_, guest.lane,
                                                 addresses_.account(guest.address), environment_);
  const bool is_new = sessions_.emplace(guest.id, session).second;
  assert(is_new && !is_stopping_);
  count_sessions(guest, is_new);
  if (!guest.is_confidential) session->is_read_by_others();
  auto closed = [this, guest] { asio::post(strand_, [this, guest] { on_closed(guest); }); };
  if (guest.refusal) return session->start_refused(*guest.refusal, std::move(closed));
  session->start(std::move(closed), greeting);
}

/// No session came of it.
void Acceptor::end_visit(SessionId id) {
  assert(!sessions_.contains(id));
  addresses_.release(take_visit(id).address, environment_.timekeeper.now());
  tell_when_empty();
}

void Acceptor::on_closed(const Guest& guest) {
  addresses_.release(guest.address, environment_.timekeeper.now());
  sessions_.erase(guest.id);
  count_sessions(guest, false);
  tell_when_empty();
}

/// One more, or one less, for who counts them.
void Acceptor::count_sessions(const Guest& guest, bool is_new) {
  TrafficMetrics& traffic = environment_.traffic;
  traffic.sessions.store(sessions_.size(), std::memory_order_relaxed);
  if (!guest.is_web) return;
  assert(is_new || traffic.web_sessions > 0);
  is_new ? ++traffic.web_sessions : --traffic.web_sessions;
}

void Acceptor::expel(IsMeant is_meant, protocol::ErrorMessage why, std::function<void(std::size_t)> done) {
  asio::post(strand_,
             [this, is_meant = std::move(is_meant), why = std::move(why), done = std::move(done)]() mutable {
               std::size_t count = 0;
               for (auto& [id, session] : sessions_) {
                 if (!is_meant(id, session->address())) continue;
                 session->expel(why);
                 ++count;
               }
               for (auto& [id, visit] : visits_)
                 if (is_meant(id, visit.guest.address)) visit.end();
               done(count);
             });
}

void Acceptor::ask_addresses(std::function<void(std::map<SessionId, std::string>)> told) {
  asio::post(strand_, [this, told = std::move(told)] {
    std::map<SessionId, std::string> addresses;
    for (const auto& [id, session] : sessions_) addresses.emplace(id, session->address());
    told(std::move(addresses));
  });
}

void Acceptor::stop(protocol::Bye bye, std::function<void()> stopped) {
  asio::post(strand_, [this, bye = std::move(bye), stopped = std::move(stopped)]() mutable {
    is_stopping_ = true;
    lines_.close();
    web_.close();
    for (auto& [id, session] : sessions_) session->end(bye);
    for (auto& [id, visit] : visits_) visit.end();
    stopped_ = std::move(stopped);
    tell_when_empty();
  });
}

/// As a session does, within what its address may cause.
void Acceptor::log(LogEvent event, const std::string& address, const std::string& what) {
  if (!is_logged(*environment_.log, event)) return;
  const auto left_out = addresses_.account(address)->take_log_line(environment_.timekeeper.now());
  if (!left_out) return;
  const std::string others =
      *left_out == 0 ? "" : fmt::format(" ({} lines of this address left out)", *left_out);
  log_event(*environment_.log, event, fmt::format("{}: {}{}", address, what, others));
}

}  // namespace woodlouse::server
