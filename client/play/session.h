// The room view and its line to the server, wired together.
#pragma once

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <optional>
#include <string_view>

#include "client/net/connection.h"
#include "client/play/room_view.h"
#include "shared/core/clock.h"
#include "shared/core/error.h"

namespace woodlouse::client {

class Session final : private ConnectionListener {
 public:
  Session(boost::asio::io_context& context, const Address& address, protocol::Join join);

  /// Ends the line. A signal says no more then.
  ~Session() override;

  /// Runs the io_context until the server has welcomed us; from then on a signal that ends the program says
  /// good-bye, too. Error: why it did not.
  core::Expected<void> join();
  /// Runs the room on to now and sends what it has to say.
  void update(core::Time now);
  /// Says good-bye to the server and ends the line, waiting at most 200 ms for the words to go out.
  void leave();

  [[nodiscard]] RoomView& room() { return room_; }
  [[nodiscard]] const RoomView& room() const { return room_; }
  /// Whether it tries to join, for the first time or again.
  [[nodiscard]] bool is_trying() const {
    return connection_.phase() == Connection::Phase::kConnecting ||
           connection_.phase() == Connection::Phase::kWaiting;
  }
  [[nodiscard]] const Connection& connection() const { return connection_; }
  /// Why this server can't be played with, or not any more, and what to do; empty while it can.
  [[nodiscard]] const std::optional<core::Error>& failure() const { return failure_; }
  [[nodiscard]] std::chrono::milliseconds join_time() const { return join_time_; }

 private:
  void on_message(const protocol::ServerMessage& message, core::Time arrival) override;
  void on_recorded(std::string_view line, core::Time arrival) override;
  void on_lost() override;
  /// Where the room is, to whom that is news.
  void tell_where(const protocol::Welcome& welcome, core::Time now);
  /// What to tell when the connection is over.
  [[nodiscard]] core::Error farewell() const;

  boost::asio::io_context& context_;
  RoomView room_;
  Connection connection_;
  Address told_;  ///< where the room is, as the player knows it
  std::optional<core::Error> failure_;
  std::chrono::milliseconds join_time_{0};
};

}  // namespace woodlouse::client
