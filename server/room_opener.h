// Makes the rooms of a server, those of its command line and those that its operator opens later, the same
// way.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>

#include <cstdint>
#include <memory>
#include <string>

#include "server/companions.h"
#include "server/config.h"
#include "server/room/lanes.h"
#include "server/room/room.h"
#include "server/room/rotation.h"
#include "server/room/start.h"
#include "server/timing/live_limits.h"
#include "server/timing/timekeeper.h"
#include "shared/core/error.h"

namespace woodlouse::server {

/// Any thread; may wait for a disk.
class RoomOpener {
 public:
  /// All outlive it.
  RoomOpener(boost::asio::io_context& ticks, const Lanes& lanes, const LiveLimits& limits,
             Companions& companions, Timekeeper& timekeeper, std::shared_ptr<spdlog::logger> log)
      : ticks_(ticks),
        lanes_(lanes),
        limits_(limits),
        companions_(companions),
        timekeeper_(timekeeper),
        log_(std::move(log)) {}

  /// A room that has not begun, with who works beside its game. rotation: where its next games come from;
  /// null: it has none. Errors: what can't be written.
  core::Expected<std::shared_ptr<Room>> make(const ServeConfig& config, const std::string& name, Start start,
                                             Rotation* rotation = nullptr);

 private:
  void log_opened(const std::string& room, std::uint32_t state_hz, const Start& start) const;

  boost::asio::io_context& ticks_;
  const Lanes& lanes_;
  const LiveLimits& limits_;
  Companions& companions_;
  Timekeeper& timekeeper_;
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace woodlouse::server
