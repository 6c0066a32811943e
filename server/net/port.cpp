#include "server/net/port.h"

#include <spdlog/fmt/fmt.h>

#include <cassert>
#include <chrono>
#include <utility>

#include "server/logging/events.h"
#include "server/timing/clock.h"
#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr Duration kPause = std::chrono::milliseconds(100);  // after accepting failed

core::Error cannot_listen(const std::string& option, const ListenAddress& address, const error_code& error) {
  const std::string same = "try the same with  " + option + ' ';
  core::Error failure{"cannot listen on " + to_text(address), error.message(), {}};
  if (error == asio::error::address_in_use) {
    failure.what = "address already in use";
    failure.hint = core::joined({"another woodlouse server?   ", same, "127.0.0.1:0   (picks a free port)"});
  } else if (error == asio::error::access_denied) {
    failure.hint = core::joined({"ports below 1024 are reserved   ", same, ":7777"});
  } else {
    failure.hint = core::joined({same, "127.0.0.1:7777"});
  }
  return failure;
}

}  // namespace

Port::Port(const Lanes& lanes, const Strand& strand, std::shared_ptr<spdlog::logger> log, std::string option,
           TrafficMetrics& traffic)
    : lanes_(lanes),
      log_(std::move(log)),
      option_(std::move(option)),
      traffic_(traffic),
      acceptor_(strand),
      pause_(strand) {
  assert(log_ != nullptr && !option_.empty());
}

core::Expected<tcp::endpoint> Port::open(const ListenAddress& address) {
  error_code error;
  tcp::resolver resolver(lanes_.io());
  const auto found =
      resolver.resolve(address.host, std::to_string(address.port), tcp::resolver::passive, error);
  if (error) return tl::unexpected(cannot_listen(option_, address, error));
  const tcp::endpoint endpoint = found.begin()->endpoint();
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  // Else asio waits for the next one, while others wait behind the one that has gone.
  if (!error) acceptor_.set_option(asio::socket_base::enable_connection_aborted(true), error);
  const tcp::endpoint bound = error ? endpoint : acceptor_.local_endpoint(error);
  if (error) return tl::unexpected(cannot_listen(option_, address, error));
  return bound;
}

void Port::start(Taken taken) {
  assert(!taken_ && taken);
  taken_ = std::move(taken);
  if (acceptor_.is_open()) accept();
}

void Port::accept() {
  const std::size_t lane = next_lane_++ % lanes_.size();
  acceptor_.async_accept(lanes_[lane], [this, lane](const error_code& error, tcp::socket socket) {
    on_accept(error, std::move(socket), lane);
  });
}

void Port::on_accept(const error_code& error, tcp::socket socket, std::size_t lane) {
  if (!acceptor_.is_open()) return;
  if (error) {
    traffic_.refuse(RefusedConnection::kNotAccepted);
    // Out of descriptors or memory, or the client has gone already: nothing that stops the server.
    if (!std::exchange(starved_, true))
      log_event(*log_, LogEvent::kAcceptFailed,
                fmt::format("cannot accept a connection: {}", error.message()));
    return pause();
  }
  starved_ = false;
  taken_(std::move(socket), lane);
  accept();
}

void Port::pause() {
  pause_.expires_after(kPause);
  pause_.async_wait([this](const error_code& error) {
    if (!error && acceptor_.is_open()) accept();
  });
}

void Port::close() {
  error_code error;
  acceptor_.close(error);
  if (error)
    log_event(*log_, LogEvent::kCloseFailed,
              fmt::format("closing the port of {}: {}", option_, error.message()));
  pause_.cancel();
}

}  // namespace woodlouse::server
