// The line to the server over its breaks: one Link after another. Who was welcomed once comes back with the
// token of its louse, at once and then each second, for as long as a server keeps the louse.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "client/net/closing.h"
#include "client/net/link.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

class ConnectionListener {
 public:
  virtual ~ConnectionListener() = default;
  virtual void on_message(const protocol::ServerMessage& message, core::Time arrival) = 0;
  /// A line of the room's recording, without its newline, of who watches by inputs.
  virtual void on_recorded(std::string_view /*line*/, core::Time /*arrival*/) {}
  /// The line broke, or an attempt at coming back failed. The next one follows by itself, unless phase() is
  /// kStopped: then it is over.
  virtual void on_lost() = 0;
};

class Connection final : public LinkListener {
 public:
  enum class Phase : std::uint8_t { kConnecting, kJoined, kWaiting, kStopped };

  static constexpr std::chrono::seconds kComesBackFor{30};  ///< limits.resume_s of a server left as it is
  static constexpr std::chrono::seconds kAttemptEvery{1};
  static constexpr std::chrono::seconds kFirstPatience{10};  ///< from the greeting to the first welcome
  static constexpr std::chrono::seconds kPatience{5};        ///< until the welcome of an attempt to come back

  Connection(boost::asio::io_context& context, Address address, protocol::Join join,
             ConnectionListener& listener);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void start();
  void send(const protocol::ClientMessage& message);
  void stop();
  /// Leaves and joins anew, to be shown frames, now and whenever it comes back.
  void watch_by_frames();

  /// The line's socket; -1: there is none.
  [[nodiscard]] int descriptor() const { return link_ ? link_->descriptor() : -1; }
  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] const Address& address() const { return address_; }
  /// The room that was asked for; empty: the server's first.
  [[nodiscard]] const std::string& room() const { return join_.room; }
  /// Why the last link ended, or the last attempt to get a new one.
  [[nodiscard]] const Closing& closing() const { return closing_; }
  /// Whether a server has ever welcomed us.
  [[nodiscard]] bool was_joined() const { return was_joined_; }
  /// How often the line broke, attempts to come back apart.
  [[nodiscard]] int losses() const { return losses_; }
  /// Seconds for which it will still be tried; nothing while the line is up, and once nothing is tried.
  [[nodiscard]] std::optional<double> seconds_left(core::Time now) const;

  // Of the link, for it alone to call.
  void on_message(const protocol::ServerMessage& message, core::Time arrival) override;
  void on_recorded(std::string_view line, core::Time arrival) override {
    listener_.on_recorded(line, arrival);
  }
  void on_closed(const Closing& closing) override;

 private:
  void try_again(core::Time at);

  boost::asio::io_context& context_;
  Address address_;
  protocol::Join join_;  ///< with the token of the louse that we have, or had
  ConnectionListener& listener_;
  boost::asio::steady_timer retry_;
  std::shared_ptr<Link> link_;
  Phase phase_ = Phase::kStopped;
  Closing closing_;
  bool was_joined_ = false;
  int losses_ = 0;
  core::Time started_{};             ///< the last attempt
  std::optional<core::Time> until_;  ///< while the line is down: when nothing is tried any more
};

}  // namespace woodlouse::client
