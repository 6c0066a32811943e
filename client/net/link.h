// One TCP connection to a server, from the name look-up to its end: lines in, messages out, and back.
// Says hello properly (join after hello), watches for silence, and reports its end once.
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "client/net/address.h"
#include "client/net/closing.h"
#include "shared/core/clock.h"
#include "shared/protocol/framing.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// Who hears what a link says; called from the io_context's thread.
class LinkListener {
 public:
  virtual ~LinkListener() = default;
  virtual void on_message(const protocol::ServerMessage& message, core::Time arrival) = 0;
  /// A line of the room's recording, without its newline, of who watches by inputs.
  virtual void on_recorded(std::string_view line, core::Time arrival) = 0;
  /// The link has ended; nothing comes after it.
  virtual void on_closed(const Closing& closing) = 0;
};

/// Held by shared_ptr: its pending operations keep it alive. Single thread.
class Link : public std::enable_shared_from_this<Link> {
 public:
  static constexpr std::size_t kMaxLineBytes = 160u << 20;   ///< the largest map fits
  static constexpr std::size_t kMaxHelloBytes = 256u << 10;  ///< of the line before any: many times a hello
  static constexpr std::size_t kMaxUnsentBytes =
      256u << 10;  ///< beyond it the link ends: the server takes nothing
  static constexpr std::chrono::seconds kReachPatience{3};  ///< until somebody takes the connection
  static constexpr std::chrono::seconds kGreetPatience{2};  ///< until a server greets then
  static constexpr std::chrono::seconds kSilence{5};  ///< an open link says something at least every second

  Link(boost::asio::io_context& context, protocol::Join join, LinkListener& listener);

  /// patience: for the time from the greeting to the welcome.
  void open(const Address& address, std::chrono::seconds patience);
  /// Queues a message; nothing before the welcome and after the end.
  void send(const protocol::ClientMessage& message);
  /// Ends it without a report. The listener is not called again.
  void close();
  /// The socket; -1: none is open.
  [[nodiscard]] int descriptor();

 private:
  using Tcp = boost::asio::ip::tcp;

  void on_resolved(const Tcp::resolver::results_type& endpoints);
  void read();
  void take_lines();
  void take(const protocol::ServerMessage& message);
  void write(const std::string& line);
  void flush();
  void watch(std::chrono::seconds patience, std::string reason);
  void end(Closing closing);

  protocol::Join join_;
  LinkListener* listener_;  ///< null once closed
  Tcp::resolver resolver_;
  Tcp::socket socket_;
  boost::asio::steady_timer watchdog_;
  protocol::LineFramer framer_{kMaxHelloBytes};
  std::array<char, 64u << 10> incoming_{};
  std::string sending_;  ///< under way to the socket
  std::string unsent_;
  bool joined_ = false;
  Reached reached_ = Reached::kNothing;
  std::chrono::seconds patience_{0};
  std::optional<protocol::Join> by_frames_;  ///< asked for where the room can't be watched by inputs
  protocol::Welcome welcome_;
  std::optional<Closing> farewell_;  ///< what a fatal error or a bye gave as the reason
};

}  // namespace woodlouse::client
