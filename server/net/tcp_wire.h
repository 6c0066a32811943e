// A connection over TCP.
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <chrono>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "server/net/wire.h"

namespace woodlouse::server {

/// What is written leaves at once, and little of it waits in the kernel; what the other side's system takes
/// no notice of for `patience` breaks the connection. A wire also works where this fails, with fresh frames
/// coming later and ends seen later.
[[nodiscard]] boost::system::error_code set_options(boost::asio::ip::tcp::socket& socket,
                                                    std::chrono::milliseconds patience);

class TcpWire final : public Wire {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  /// The socket is connected; its executor is the lane.
  explicit TcpWire(Socket socket) : socket_(std::move(socket)) {}

  void read_some(std::span<char> into, Handler handler) override;
  [[nodiscard]] std::size_t write_now(std::span<const Line> lines) override;
  void write(std::span<const Line> lines, std::size_t skipped, Handler handler) override;
  [[nodiscard]] boost::system::error_code shut_down_sending() override;
  [[nodiscard]] boost::system::error_code close() override;

 private:
  void gather(std::span<const Line> lines, std::size_t skipped);

  Socket socket_;
  std::vector<boost::asio::const_buffer> buffers_;  ///< of the write that runs
};

}  // namespace woodlouse::server
