// The line to the server over its breaks: one Link after another. Who was welcomed once comes back with the
// token of its louse, soon and then later and later, where it was and at the hosts that were named there; who
// is sent on to where the room is follows at once.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/net/closing.h"
#include "client/net/link.h"
#include "shared/core/clock.h"
#include "shared/protocol/whereabouts.h"

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

  /// Longer than a server left as it is keeps a louse (limits.resume_s): another one takes the room over.
  static constexpr std::chrono::seconds kComesBackFor{60};
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
  /// Of the server that is joined or tried.
  [[nodiscard]] const Address& address() const { return address_; }
  /// The one joined last, or the one asked for; empty: the server's first.
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
  /// Whether it goes on at once where it was sent. What came of it is in closing_.
  bool follows(std::optional<double> up_for);
  void try_again(core::Time at);
  [[nodiscard]] bool may_say_password() const;

  boost::asio::io_context& context_;
  Address asked_;  ///< for, by who began it
  Address address_;
  protocol::Whereabouts places_;
  std::vector<std::string> hosts_;  ///< as the server named them last
  protocol::Join join_;             ///< with the token of the louse that we have, or had
  ConnectionListener& listener_;
  boost::asio::steady_timer retry_;
  std::shared_ptr<Link> link_;
  Phase phase_ = Phase::kStopped;
  Closing closing_;
  bool was_joined_ = false;
  int losses_ = 0;
  core::Time joined_at_{};           ///< the last time
  std::optional<core::Time> until_;  ///< while the line is down: when nothing is tried any more
};

}  // namespace woodlouse::client
