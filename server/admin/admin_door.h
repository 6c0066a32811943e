// The operator's door to a running server: its connections, bounded, and what they may ask (control.h).
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/admin/admin_port.h"
#include "server/admin/admin_talk.h"
#include "server/admin/admin_watch.h"
#include "server/admin/control.h"
#include "server/timing/timekeeper.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class AdminDoor {
 public:
  static constexpr std::size_t kMostTalks = 32;  ///< at a time
  static constexpr std::size_t kCourtesy = 16;   ///< further ones are told so; others are just closed

  /// All outlive it.
  AdminDoor(boost::asio::io_context& io, Control& control, Timekeeper& timekeeper,
            std::shared_ptr<spdlog::logger> log);

  /// Listens; where that is. Before the threads run.
  core::Expected<std::string> open(const AdminSettings& settings);

  // Any thread:
  void start();
  /// Closes and removes the socket; `stopped` when the last connection is closed.
  void stop(std::function<void()> stopped);

 private:
  void take(AdminPort::Socket socket);
  struct Guest {
    std::shared_ptr<AdminTalk> talk;
    bool is_served = false;  ///< may command
  };
  bool end_oldest_stranger(bool is_served);
  void tell_when_empty();

  AdminPort::Strand strand_;
  Control& control_;
  Timekeeper& timekeeper_;
  AdminPort port_;
  // The strand's:
  std::optional<AdminWatch> watch_;
  std::vector<Guest> guests_;  ///< as they came
  std::size_t served_ = 0;     ///< of them, those that may command
  bool is_stopping_ = false;
  std::function<void()> stopped_;
};

}  // namespace woodlouse::server
