// The bytes of one connection, in and out. What carries them, TCP or a test's memory, is not known here.
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/function.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <span>

#include "server/room/frame.h"

namespace woodlouse::server {

/// Called on its executor only. One read and one write may run at a time.
class Wire {
 public:
  /// Called once on the executor, never within the call that it was given to; kept until then, or until the
  /// executor's context ends. size: bytes read or written. Whoever owns the wire stays alive by being
  /// captured. What captures 24 bytes at most costs no memory.
  using Handler = boost::function<void(const boost::system::error_code& error, std::size_t size)>;

  Wire() = default;
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;
  virtual ~Wire() = default;

  /// A strand where several threads run it.
  [[nodiscard]] virtual boost::asio::any_io_executor executor() = 0;

  /// Reads at least one byte into `into`, which must last until the handler is called. Fails when the other
  /// side has ended (eof), the connection is broken or close() was called.
  virtual void read_some(std::span<char> into, Handler handler) = 0;
  /// Writes all of the lines in their order; they must last until the handler is called. Fails when the
  /// connection is broken or close() was called; then part of them may have gone out.
  virtual void write(std::span<const Line> lines, Handler handler) = 0;

  /// Tells the other side that nothing more comes. Fails when it has broken the connection already.
  [[nodiscard]] virtual boost::system::error_code shut_down_sending() = 0;
  /// Ends both ways and the read and write that run. It is closed even when this fails.
  [[nodiscard]] virtual boost::system::error_code close() = 0;
};

}  // namespace woodlouse::server
