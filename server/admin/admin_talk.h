// One connection to the admin door: commands, a line each, one after the other, or one request by HTTP. The
// first byte tells which.
//
// While a command is carried out or its answer written nothing further is read, so that nothing heaps up
// here: who sends many lines, or reads none, holds up himself alone.
#pragma once

#include <boost/system/error_code.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/admin/admin_port.h"
#include "server/admin/admin_watch.h"
#include "server/admin/control.h"
#include "server/timing/timekeeper.h"

namespace woodlouse::server {

/// On the door's strand, every function.
class AdminTalk : public std::enable_shared_from_this<AdminTalk> {
 public:
  static constexpr Duration kFirstPatience = std::chrono::seconds(10);  ///< for a line, or a head
  static constexpr Duration kIdle = std::chrono::minutes(10);           ///< between commands
  static constexpr Duration kWritePatience = std::chrono::seconds(10);
  static constexpr Duration kLinger = std::chrono::seconds(1);
  static constexpr Duration kShutdownLinger = std::chrono::milliseconds(300);

  /// control, watch and timekeeper outlive it.
  AdminTalk(AdminPort::Socket socket, Control& control, AdminWatch& watch, Timekeeper& timekeeper);

  /// closed: called once, when the connection has ended.
  void start(std::function<void()> closed);
  /// Instead: that line alone.
  void start_refused(std::string line, std::function<void()> closed);
  /// It has shown no token.
  [[nodiscard]] bool is_stranger() const { return !is_trusted_; }
  /// Ends at once, whatever is on its way.
  void give_way() { close(); }
  /// The server stops: what is being written is the last.
  void end();

 private:
  enum class State : std::uint8_t {
    kReading,  ///< for a line or a head
    kWorking,  ///< a command is carried out
    kWriting,
    kDraining,  ///< nothing more is said; what still comes is thrown away
    kClosed,
  };

  void read();
  void on_read(const boost::system::error_code& error, std::size_t size);
  void take();
  void take_line();
  void take_request();
  /// Nothing: he may. Else the code and text to refuse him with.
  void write(std::string text, bool is_last);
  void on_written(const boost::system::error_code& error);
  void drain();
  void close();
  void end_at(Time until);

  AdminPort::Socket socket_;
  Control& control_;
  AdminWatch& watch_;
  Timekeeper& timekeeper_;
  std::unique_ptr<Alarm> alarm_;
  Time until_{};
  std::function<void()> closed_;
  State state_ = State::kReading;
  bool is_trusted_ = false;  ///< said a token that is right, or needs none
  bool is_last_ = false;     ///< of what is written
  Duration linger_ = kLinger;
  std::array<char, 4096> incoming_{};
  std::string unread_;
  std::string outgoing_;
};

}  // namespace woodlouse::server
