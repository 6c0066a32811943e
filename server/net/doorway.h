// What somebody speaks who has come to a port where the client speaks first: told by his first byte, which
// is looked at and left where it is. So whoever takes over reads the whole of it from the socket.
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/system/error_code.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "server/timing/timekeeper.h"

namespace woodlouse::server {

enum class Comes : std::uint8_t {
  kLines,   ///< JSON, or blanks and line ends before it
  kHttp,    ///< a method's first letter
  kTls,     ///< a handshake record
  kNothing  ///< nothing that is spoken here, or nobody said anything
};

/// By the first byte.
[[nodiscard]] Comes what_comes(unsigned char byte);

/// Waits for the first byte, for kPatience. Browsers keep spare connections on which they say nothing for
/// seconds and then send a request: no server can speak first to them.
class Doorway : public std::enable_shared_from_this<Doorway> {
 public:
  static constexpr Duration kPatience = std::chrono::seconds(10);
  /// Called once, on the socket's lane. kNothing: the socket is closed.
  using Done = std::function<void(Comes what, boost::asio::ip::tcp::socket socket)>;

  /// The socket is connected; its executor is a lane. timekeeper outlives it.
  Doorway(boost::asio::ip::tcp::socket socket, Timekeeper& timekeeper);

  // Any thread:
  void start(Done done);
  /// Waits no longer: nothing comes.
  void end();

 private:
  void wait();
  void look(const boost::system::error_code& error);
  void finish(Comes what);

  boost::asio::any_io_executor lane_;
  boost::asio::ip::tcp::socket socket_;
  Timekeeper& timekeeper_;
  std::unique_ptr<Alarm> alarm_;
  Done done_;
};

}  // namespace woodlouse::server
