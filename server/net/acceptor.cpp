#include "server/net/acceptor.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/bind_executor.hpp>
#include <boost/asio/post.hpp>

#include <chrono>
#include <utility>

#include "server/net/tcp_wire.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr Duration kPause = std::chrono::milliseconds(100);  // after accepting failed

core::Error cannot_listen(const std::string& where, const error_code& error) {
  core::Error failure{"cannot listen on " + where, error.message(), {}};
  if (error == asio::error::address_in_use) {
    failure.what = "address already in use";
    failure.hint =
        "another woodlouse server?   try the same with  --listen 127.0.0.1:0   (picks a free port)";
  } else if (error == asio::error::access_denied) {
    failure.hint = "ports below 1024 are reserved   try the same with  --listen :7777";
  } else {
    failure.hint = "try the same with  --listen 127.0.0.1:7777";
  }
  return failure;
}

}  // namespace

Acceptor::Acceptor(const Lanes& lanes, const SessionEnvironment& environment)
    : lanes_(lanes),
      environment_(environment),
      strand_(asio::make_strand(lanes.io())),
      acceptor_(strand_),
      pause_(strand_),
      addresses_(environment.limits) {}

core::Expected<tcp::endpoint> Acceptor::open(const ListenAddress& address) {
  error_code error;
  tcp::resolver resolver(lanes_.io());
  const auto found =
      resolver.resolve(address.host, std::to_string(address.port), tcp::resolver::passive, error);
  if (error) return tl::unexpected(cannot_listen(to_text(address), error));
  const tcp::endpoint endpoint = found.begin()->endpoint();
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  // Else asio waits for the next one, while others wait behind the one that has gone.
  if (!error) acceptor_.set_option(asio::socket_base::enable_connection_aborted(true), error);
  const tcp::endpoint bound = error ? endpoint : acceptor_.local_endpoint(error);
  if (error) return tl::unexpected(cannot_listen(to_text(address), error));
  return bound;
}

void Acceptor::start() {
  asio::post(strand_, [this] { accept(); });
}

void Acceptor::accept() {
  acceptor_.async_accept(lanes_[next_lane()], [this](const error_code& error, tcp::socket socket) {
    on_accept(error, std::move(socket));
  });
}

void Acceptor::on_accept(const error_code& error, tcp::socket socket) {
  if (!acceptor_.is_open()) return;
  if (error) {
    // Out of descriptors or memory, or the client has gone already: nothing that stops the server.
    if (!std::exchange(starved_, true))
      environment_.log->error(fmt::format("cannot accept a connection: {}", error.message()));
    return pause();
  }
  starved_ = false;
  open_session(std::move(socket));
  accept();
}

void Acceptor::pause() {
  pause_.expires_after(kPause);
  pause_.async_wait([this](const error_code& error) {
    if (!error && acceptor_.is_open()) accept();
  });
}

void Acceptor::open_session(tcp::socket socket) {
  error_code error;
  const tcp::endpoint remote = socket.remote_endpoint(error);
  if (error) return;  // gone before it was seen
  const std::string address = ConnectionLimits::key(remote.address());
  const Time now = environment_.timekeeper.now();
  const ConnectionLimits::Admission admission = addresses_.admit(address, now);
  if (admission == ConnectionLimits::Admission::kDrop) return;
  const auto limits = environment_.limits.now();
  const std::shared_ptr<AddressAccount>& account = addresses_.account(address);
  auto wire = std::make_unique<TcpWire>(std::move(socket));
  error = wire->set_options(std::chrono::seconds(limits->vacant_s));
  if (error && account->take_log_line(now))
    environment_.log->warn(fmt::format("socket options of {}: {}", to_text(remote), error.message()));

  const std::size_t lane = next_lane();
  const SessionId id = next_id_++;
  auto session = std::make_shared<Session>(id, std::move(wire), lanes_, lane, account, environment_);
  sessions_.emplace(id, session);
  auto closed = [this, id, address] { asio::post(strand_, [this, id, address] { on_closed(id, address); }); };
  environment_.log->debug(fmt::format("session {:016x}: from {}", id, to_text(remote)));
  if (admission == ConnectionLimits::Admission::kWelcome) return session->start(std::move(closed));
  const bool is_address = admission == ConnectionLimits::Admission::kAddressFull;
  session->start_refused(
      {std::string(protocol::code::kTooManyConnections),
       is_address ? "your address has " + std::to_string(limits->per_address) +
                        " connections already; close one first"
                  : "the server has " + std::to_string(limits->max_connections) +
                        " connections, the last of them for addresses that have none; try again later",
       true,
       {}},
      std::move(closed));
}

void Acceptor::on_closed(SessionId id, const std::string& address) {
  addresses_.release(address, environment_.timekeeper.now());
  sessions_.erase(id);
  if (stopped_ && sessions_.empty()) std::exchange(stopped_, nullptr)();
}

void Acceptor::stop(protocol::Bye bye, std::function<void()> stopped) {
  asio::post(strand_, [this, bye = std::move(bye), stopped = std::move(stopped)]() mutable {
    error_code error;
    acceptor_.close(error);
    if (error) environment_.log->warn(fmt::format("closing the port: {}", error.message()));
    pause_.cancel();
    for (auto& [id, session] : sessions_) session->end(bye);
    stopped_ = std::move(stopped);
    if (sessions_.empty()) std::exchange(stopped_, nullptr)();
  });
}

}  // namespace woodlouse::server
