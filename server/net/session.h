// One client's connection, and nothing of the game. Reads lines, judges them by the handshake's rules and the
// rate limiter, passes them to the room's door; writes what the outbox holds, one write in flight. The bytes
// go over a wire and the time comes from a timekeeper: a test stands in for both.
//
// How it ends: a fatal error, `leave`, a timeout, a slow client or the room's bye put a last line into the
// outbox; when that is written the sending side is shut, and what still comes in is read and thrown away
// until the client closes or the linger time is over (closing with unread bytes would reset the connection
// and take the bye with it).
//
// A client that ends its sending side leaves by that: it may read on, and one that has closed altogether
// looks the same. Who leaves gets every answer first: the room says when it has given its own.
#pragma once

#include <spdlog/logger.h>
#include <boost/system/error_code.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/handshake.h"
#include "server/net/outbox.h"
#include "server/net/rate_limiter.h"
#include "server/net/send_rate.h"
#include "server/net/wire.h"
#include "server/room/directory.h"
#include "server/room/door.h"
#include "server/room/figures.h"
#include "server/room/subscriber.h"
#include "server/room/timekeeper.h"
#include "shared/protocol/framing.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// What all sessions share; outlives them.
struct SessionEnvironment {
  const Directory& directory;
  const protocol::Limits& limits;
  TrafficMetrics& traffic;
  Timekeeper& timekeeper;
  std::string_view server_name;  ///< with its version
  std::shared_ptr<spdlog::logger> log;
};

class Session final : public Subscriber, public std::enable_shared_from_this<Session> {
 public:
  /// What a line weighs against the rate that goes out to a whole room, or brings a long answer.
  static constexpr double kBroadcastCost = 10.0;
  /// From a fatal error on, or once a goodbye is written.
  static constexpr Duration kLinger = std::chrono::seconds(1);
  static constexpr Duration kShutdownLinger = std::chrono::milliseconds(300);

  /// The wire's executor is the session's: what is not said to be of any thread runs there alone.
  Session(SessionId id, std::unique_ptr<Wire> wire, const SessionEnvironment& environment);

  // One of the two, once; any thread.

  /// Says hello and begins to read. closed: called once, on the session's executor, when the wire is closed.
  void start(std::function<void()> closed);
  /// Instead of start(): an error and a bye, no hello.
  void start_refused(protocol::ErrorMessage why, std::function<void()> closed);

  // Subscriber: any thread.
  void deliver(Line line) override;
  void answer(protocol::ServerMessage message) override;
  void show(const Frame& frame) override;
  void show_again(const Frame& frame) override;
  void deliver_map(Line line) override;
  void refuse_join(protocol::ErrorMessage error) override;
  void welcome(protocol::Welcome welcome, std::uint32_t divisor) override;
  void let_go() override;
  void end(protocol::Bye bye) override;

 private:
  enum class State {
    kOpen,
    kSayingBye,  ///< the last line waits in the outbox or is being written
    kDraining,   ///< our side is shut; waiting for the client's
    kClosed,
  };

  void read();
  void on_read(const boost::system::error_code& error, std::size_t size);
  void on_input_ended();
  [[nodiscard]] bool is_listening() const;
  void on_line(const protocol::LineFramer::Line& line, Time now);
  void on_message(protocol::ClientMessage message, Time now);
  bool admit_line(Time now, double cost);

  void say(const protocol::ServerMessage& message);
  void push(Line line);
  void write();
  void on_written(const boost::system::error_code& error, std::size_t size);
  void tell_pace(SendRate::Change change);

  void fail(std::string_view code, std::string text);
  void fail(const protocol::ErrorMessage& error);
  void say_goodbye();
  void say_bye(const std::optional<protocol::ErrorMessage>& error, const protocol::Bye& bye,
               Outbox::Replaceable replaceable, Duration linger);
  void leave_room();
  void close();

  [[nodiscard]] Time now() const { return environment_.timekeeper.now(); }
  void watch(Time until);
  void on_watch();

  SessionId id_;
  std::unique_ptr<Wire> wire_;
  const SessionEnvironment& environment_;
  std::function<void()> closed_;

  State state_ = State::kOpen;
  Handshake handshake_;
  std::shared_ptr<Door> door_;  ///< null before the join
  std::array<char, 16384> incoming_{};
  protocol::LineFramer framer_;
  bool input_ended_ = false;  ///< the client has shut its sending side: nothing is left to read
  RateLimiter limiter_;

  LinePool answers_;
  Outbox outbox_;
  Outbox::Batch writing_;  ///< in flight; empty: none
  SendRate rate_;
  std::uint32_t divisor_ = 1;

  std::unique_ptr<Alarm> watch_;
  Time handshake_until_;
  Time active_;  ///< the last line read or write finished
  Time linger_until_{};
};

}  // namespace woodlouse::server
