// One TCP connection that gives out whole lines. All connections of a thread read into one buffer: thousands
// of them cost what their sockets do.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/swarm/line_cutter.h"

namespace woodlouse::swarm {

/// Where to and from.
struct Route {
  std::vector<boost::asio::ip::tcp::endpoint> servers;  ///< tried one after the other, not empty
  std::optional<boost::asio::ip::address_v4> from;
  bool has_small_buffer = false;  ///< so that the server soon sees that nobody reads
  std::size_t retries = 0;        ///< of connects that are refused or time out
};

/// Who is called by it; may call it back, but not destroy it meanwhile.
class ConnectionUser {
 public:
  using Clock = std::chrono::steady_clock;
  virtual ~ConnectionUser() = default;
  /// False: nothing more is wanted of what was read.
  virtual bool on_line(std::string_view line, Clock::time_point now) = 0;
  virtual void on_lost(std::string reason) = 0;
};

/// Lives on one io_context, in one thread; outlives the run of that context.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;
  using Tcp = boost::asio::ip::tcp;

  /// cuts_lines: else what comes is counted alone.
  Connection(boost::asio::io_context& context, ConnectionUser& user, bool cuts_lines = true);

  /// Connects and reads. Not while it is open.
  void open(const Route& route);
  void send(std::string_view lines);
  void stop_reading() { is_reading_ = false; }
  /// Without a word: the server's next byte is answered by a reset.
  void abort();
  void close();

  [[nodiscard]] std::uint64_t received() const { return received_; }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  /// Connects that were refused or timed out and tried again.
  [[nodiscard]] std::uint64_t retried() const { return retried_; }

 private:
  void connect();
  void on_connect_failed(const boost::system::error_code& error);
  boost::system::error_code prepare(const Tcp::endpoint& server);
  void wait_to_read();
  void read();
  void flush();
  void lose(std::string reason);

  static constexpr std::size_t kMaxUnsentBytes = 1 << 20;  ///< past it the server takes nothing any more
  static constexpr auto kBeforeRetry = std::chrono::milliseconds(100);

  ConnectionUser& user_;
  bool cuts_lines_;
  Tcp::socket socket_;
  boost::asio::steady_timer retry_;
  Route route_;
  std::size_t attempts_ = 0;
  std::uint64_t generation_ = 0;  ///< of the socket: what was asked of a former one is not listened to
  bool is_open_ = false, is_connected_ = false, is_reading_ = false;
  LineCutter cutter_;
  std::string sending_, unsent_;
  std::uint64_t received_ = 0, sent_ = 0, retried_ = 0;
};

}  // namespace woodlouse::swarm
