// A connection over TCP.
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <utility>
#include <vector>

#include "server/net/wire.h"

namespace woodlouse::server {

class TcpWire final : public Wire {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  /// The socket is connected; its executor becomes the wire's.
  explicit TcpWire(Socket socket) : socket_(std::move(socket)) {}

  /// What is written leaves at once, and little of it waits in the kernel. The wire also works where this
  /// fails, with fresh frames coming later.
  [[nodiscard]] boost::system::error_code set_options();

  [[nodiscard]] boost::asio::any_io_executor executor() override { return socket_.get_executor(); }
  void read_some(std::span<char> into, Handler handler) override;
  void write(std::span<const Line> lines, Handler handler) override;
  [[nodiscard]] boost::system::error_code shut_down_sending() override;
  [[nodiscard]] boost::system::error_code close() override;

 private:
  Socket socket_;
  std::vector<boost::asio::const_buffer> buffers_;  ///< of the write that runs
};

}  // namespace woodlouse::server
