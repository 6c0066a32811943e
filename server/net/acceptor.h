// Opens the port and turns connections into sessions; keeps them until they are closed.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>

#include "server/net/connection_limits.h"
#include "server/net/listen_address.h"
#include "server/net/session.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class Acceptor {
 public:
  /// All outlive it.
  Acceptor(const Lanes& lanes, const SessionEnvironment& environment);

  /// Listens. Before the threads run.
  core::Expected<boost::asio::ip::tcp::endpoint> open(const ListenAddress& address);

  // Any thread:
  void start();
  /// Closes the port, says bye to who is left; `stopped` when the last session is closed.
  void stop(protocol::Bye bye, std::function<void()> stopped);

 private:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;

  void accept();
  void on_accept(const boost::system::error_code& error, boost::asio::ip::tcp::socket socket);
  void open_session(boost::asio::ip::tcp::socket socket);
  [[nodiscard]] std::size_t next_lane() const { return static_cast<std::size_t>(next_id_ % lanes_.size()); }
  void on_closed(SessionId id, const std::string& address);
  void pause();

  const Lanes& lanes_;
  const SessionEnvironment& environment_;
  Strand strand_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  // The strand's:
  ConnectionLimits addresses_;
  std::unordered_map<SessionId, std::shared_ptr<Session>> sessions_;
  SessionId next_id_ = 1;
  bool starved_ = false;  ///< accepting failed last time; told once
  std::function<void()> stopped_;
};

}  // namespace woodlouse::server
