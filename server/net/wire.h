// The bytes of one connection, in and out. What carries them, TCP or a test's memory, is not known here.
#pragma once

#include <boost/function.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <span>

#include "server/frames/frame.h"

namespace woodlouse::server {

/// Called on its lane only. One read and one write may run at a time.
class Wire {
 public:
  /// Called once on the lane, never within the call that it was given to; kept until then, or until the
  /// lane's context ends. size: bytes read or written. Whoever owns the wire stays alive by being
  /// captured. What captures 24 bytes at most costs no memory.
  using Handler = boost::function<void(const boost::system::error_code& error, std::size_t size)>;

  Wire() = default;
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;
  virtual ~Wire() = default;

  /// Reads at least one byte into `into`, which must last until the handler is called. Fails when the other
  /// side has ended (eof), the connection is broken or close() was called.
  virtual void read_some(std::span<char> into, Handler handler) = 0;
  /// Writes of the lines, in their order, what goes out at once; how many bytes that is. 0 also when it
  /// fails, which the next write() says. REQUIRES that no write runs.
  [[nodiscard]] virtual std::size_t write_now(std::span<const Line> lines) = 0;
  /// Writes the lines in their order, but for the first `skipped` bytes; they must last until the handler is
  /// called. Fails when the connection is broken or close() was called; then part of them may have gone out.
  virtual void write(std::span<const Line> lines, std::size_t skipped, Handler handler) = 0;

  /// Tells the other side that nothing more comes. Fails when it has broken the connection already.
  [[nodiscard]] virtual boost::system::error_code shut_down_sending() = 0;
  /// Ends both ways and the read and write that run. It is closed even when this fails.
  [[nodiscard]] virtual boost::system::error_code close() = 0;
};

}  // namespace woodlouse::server
