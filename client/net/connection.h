// The line to the server over its breaks: one Link after another, with a countdown between.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <string>

#include "client/net/link.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

/// Seconds before attempt `attempt` (1, 2, ...): 1, 2, 4, 8, then 15.
std::chrono::seconds retry_delay(int attempt);

class ConnectionListener {
 public:
  virtual ~ConnectionListener() = default;
  virtual void on_message(const protocol::ServerMessage& message, core::Time arrival) = 0;
  /// The line broke, or an attempt failed; the next one follows by itself unless stop() is called.
  virtual void on_lost() = 0;
};

class Connection final : public LinkListener {
 public:
  enum class Phase : std::uint8_t { kConnecting, kJoined, kWaiting, kStopped };

  Connection(boost::asio::io_context& context, Address address, protocol::Join join,
             ConnectionListener& listener);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void start();
  void send(const protocol::ClientMessage& message);
  void stop();

  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] const Address& address() const { return address_; }
  /// Why the last link ended.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// Whether the server ever sent a message.
  [[nodiscard]] bool was_answered() const { return was_answered_; }
  /// Whether a server has ever welcomed us.
  [[nodiscard]] bool was_joined() const { return was_joined_; }
  /// Failed attempts since the line was last up.
  [[nodiscard]] int attempts() const { return attempts_; }
  /// Seconds to the next attempt; 0 while connecting.
  [[nodiscard]] double retry_seconds(core::Time now) const;

  // Of the link, for it alone to call.
  void on_message(const protocol::ServerMessage& message, core::Time arrival) override;
  void on_closed(const std::string& reason) override;

 private:
  boost::asio::io_context& context_;
  Address address_;
  protocol::Join join_;
  ConnectionListener& listener_;
  boost::asio::steady_timer retry_;
  std::shared_ptr<Link> link_;
  Phase phase_ = Phase::kStopped;
  std::string reason_;
  bool was_joined_ = false;
  bool was_answered_ = false;
  int attempts_ = 0;
};

}  // namespace woodlouse::client
