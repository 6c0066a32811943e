// Where a trusted proxy says whose connection it passes on, before anything else: a header of the PROXY
// protocol is taken from the socket, and nothing behind it. What is no header is left where it is.
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <functional>
#include <memory>

#include "server/proxies/proxy_header.h"
#include "server/timing/timekeeper.h"

namespace woodlouse::server {

class ProxyDoorway : public std::enable_shared_from_this<ProxyDoorway> {
 public:
  /// Called once, on the socket's lane. kWhole, kRefused, or kNone: there is no header, or nothing was said
  /// for as long as it was waited.
  using Done = std::function<void(ProxyHeader header, boost::asio::ip::tcp::socket socket)>;

  /// The socket is connected; its executor is a lane. timekeeper outlives it.
  ProxyDoorway(boost::asio::ip::tcp::socket socket, Timekeeper& timekeeper, Duration patience);

  // Any thread:
  void start(Done done);
  /// Waits no longer.
  void end();

 private:
  void wait();
  void look(const boost::system::error_code& error);
  void want(std::size_t bytes);
  [[nodiscard]] bool has_ended();
  void give_up();
  void finish(ProxyHeader header);

  boost::asio::any_io_executor lane_;
  boost::asio::ip::tcp::socket socket_;
  Timekeeper& timekeeper_;
  Duration patience_;
  std::unique_ptr<Alarm> alarm_;
  std::size_t wanted_ = 1;  ///< bytes, from which on there is something to look at
  Done done_;
};

}  // namespace woodlouse::server
