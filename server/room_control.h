// What an operator asks of rooms: opened, closed, paused, stepped, recorded. What waits for a disk is done on
// a thread of its own.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/admin/control.h"
#include "server/companions.h"
#include "server/config.h"
#include "server/room/lobby.h"
#include "server/room_opener.h"
#include "server/stream/map_shelf.h"
#include "server/timing/live_limits.h"

namespace woodlouse::server {

/// On the server's strand, but for the constructor.
class RoomControl {
 public:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;
  using Answered = Control::Answered;
  /// What the server counts: a room begins, or is closed by its operator. On its strand.
  struct Counts {
    std::function<bool(std::shared_ptr<Room>)> open;  ///< false: there is one of that name
    std::function<void(const std::string& room)> closed;
  };

  /// All outlive it. config: of the command line.
  RoomControl(const Strand& strand, Lobby& lobby, RoomOpener& opener, Companions& companions,
              const LiveLimits& limits, ServeConfig config, Counts counts,
              std::shared_ptr<spdlog::logger> log);
  /// Waits for a room that is being made.
  ~RoomControl() { end(); }

  /// Before it is asked for anything; not where nobody will ask. Throws std::system_error where the system
  /// gives no thread.
  void begin() { slow_.emplace(1); }

  void open(const Command& command, Answered answered);
  void close(const Command& command, const Answered& answered);
  void pause(const Command& command, Answered answered);
  void resume(const Command& command, Answered answered);
  void step(const Command& command, Answered answered);
  void record(const Command& command, Answered answered);
  void end();

 private:
  using Give = std::function<void(Room&, Room::Ordered)>;
  /// Has it done in the room that is named, or in all of them, and answers once for all. done: "paused".
  void order(const Command& command, const std::string& done, const Give& give, Answered answered);
  using Made = std::vector<std::shared_ptr<Room>>;
  void open_made(const Made& rooms, const Answered& answered);
  void make_rooms(const ServeConfig& config, std::uint64_t seed, const std::string& name,
                  const Answered& answered);
  void begin_recording(Room& room, Room::Ordered answered);

  Strand strand_;
  Lobby& lobby_;
  RoomOpener& opener_;
  Companions& companions_;
  const LiveLimits& limits_;
  const ServeConfig config_;
  Counts counts_;
  std::shared_ptr<spdlog::logger> log_;
  std::uint64_t opened_ = 0;  ///< makes their seeds differ
  /// Made and not yet opened; kept here, that a server which ends meanwhile ends them in time.
  std::list<Made> made_;
  MapShelf maps_;  ///< of rooms that were opened
  std::mutex made_mutex_;
  std::optional<boost::asio::thread_pool> slow_;
};

/// The room of that name, or all for an empty name; empty: there is none such.
[[nodiscard]] std::vector<std::shared_ptr<Room>> chosen_rooms(const Lobby& lobby, const std::string& name);
/// The answer where there is none.
[[nodiscard]] std::string no_such_room(const Lobby& lobby, const std::string& name);

}  // namespace woodlouse::server
