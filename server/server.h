// The whole server: rooms, port, threads, signals, and the order in which they start and stop.
//
// Threads: rooms tick in a context of their own (one thread for each room, at most one a core), sockets and
// broadcasts run in another (kIoThreads, a lane each), recordings are written on a thread each, tiles of big
// maps are built ahead of lice on another, shadows re-run games on as many as rooms tick on. A tick so never
// waits for a socket, and for a disk only where a louse outruns the tiles. With --step-threads there is one
// team of threads more, which a room with many lice has for its tick; a room that finds it taken goes
// without. With --cluster two more speak to NATS, and libnats has threads of its own.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/access/doorman.h"
#include "server/admin/admin_door.h"
#include "server/ban_desk.h"
#include "server/chosen_games.h"
#include "server/cluster/room_guide.h"
#include "server/cluster_desk.h"
#include "server/companions.h"
#include "server/config.h"
#include "server/game_rotation.h"
#include "server/metrics/metrics.h"
#include "server/moderation.h"
#include "server/net/acceptor.h"
#include "server/net/session.h"
#include "server/operator.h"
#include "server/room/lanes.h"
#include "server/room/lobby.h"
#include "server/room/room.h"
#include "server/room/start.h"
#include "server/room_control.h"
#include "server/room_opener.h"
#include "server/signals.h"
#include "server/timing/figures.h"
#include "server/timing/live_limits.h"
#include "server/timing/steady_timekeeper.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class Server {
 public:
  /// What a signal asks of those around it.
  struct Outside {
    std::function<core::Expected<ServeConfig>()> reread;  ///< HUP: the configuration once more
    std::function<void()> reopen_log;                     ///< USR1
    std::function<std::uint64_t()> lost_log_lines;        ///< for /metrics; any thread
  };

  static constexpr std::size_t kIoThreads = 2;
  /// From the signal to the exit at most.
  static constexpr Duration kStopWithin = std::chrono::milliseconds(800);
  /// Before that, for a cluster's rooms to go on at another host.
  static constexpr Duration kMoveWithin = std::chrono::milliseconds(400);

  /// Loads the maps or the recording to go on from, opens the ports, creates the recordings.
  static core::Expected<std::unique_ptr<Server>> create(ServeConfig config, Outside outside,
                                                        std::shared_ptr<spdlog::logger> log);
  ~Server();

  /// `127.0.0.1:7777`, with the port that was really taken.
  [[nodiscard]] const std::string& address() const { return address_; }
  /// `http://127.0.0.1:7778/`, likewise; empty: there is no --web.
  [[nodiscard]] const std::string& web_url() const { return environment_.web_url; }

  /// Where the operator's door is; empty: there is none.
  [[nodiscard]] const std::string& admin_address() const { return admin_address_; }

  /// Serves until a signal ends it or the tick limit; everybody has been told and all is written when it
  /// returns.
  void run();

  /// New files for what is written all the time: the log and the recordings. At USR1, on the server's strand;
  /// files are not opened here, as a disk may stand still.
  void reopen();

  /// "FILE: why", of each recording that ended before its time. After run().
  [[nodiscard]] std::vector<std::string> lost_recordings() const { return companions_.lost_recordings(); }
  /// "FILE: which run", of each record that is in no file. After run().
  [[nodiscard]] std::vector<std::string> lost_records() const { return companions_.lost_records(); }

  /// Ticks, lateness, moves of the clock, frames; one line a room, one for all, and one a lost
  /// recording. After run().
  void print_summary(std::ostream& out) const;

 private:
  Server(const ServeConfig& config, Outside outside, std::shared_ptr<spdlog::logger> log);
  core::Expected<void> open_ports(const ServeConfig& config);
  core::Expected<void> open_rooms(const ServeConfig& config);
  core::Expected<void> open_rotation(const ServeConfig& config, std::vector<ChosenGame> games,
                                     std::uint64_t seed);
  core::Expected<void> join_cluster(const ServeConfig& config);
  core::Expected<void> open_fork_room(const ServeConfig& config, Start start);
  /// From here on a signal waits for run(), which writes down and says bye. Before, nothing is begun that it
  /// would cut short: maps, which may take long, are loaded, and no recording is created.
  void take_signals() {
    for (const int signal : taken_signals()) signals_.add(signal);
  }
  core::Expected<void> use_passwords(const ServeConfig& config);
  core::Expected<void> open_room(const ServeConfig& config, const std::string& name, Start start);
  /// False: there is one of its name, or it is too late. Before the threads run, or on the strand.
  bool open(std::shared_ptr<Room> room);
  void await_signal() {
    signals_.async_wait([this](const boost::system::error_code& error, int signal) {
      if (!error) on_signal(signal);
    });
  }
  void on_signal(int signal);
  /// who: asks for it, for the log. done: called once, on some thread.
  void reload(const std::string& who, Operator::Reloaded done);
  void room_ended(const std::string& name) {
    rooms_running_.erase(name);
    if (rooms_running_.empty()) stop("the game is over", "ticks done");
  }
  /// The rooms of a cluster go on elsewhere first.
  void stop(const std::string& text, const std::string& reason) {
    if (std::exchange(stopping_, true)) return;
    const auto stop_all = [this, text, reason] { stop_parts(text, reason); };
    if (!cluster_ || !cluster_->move_away(stop_all)) return stop_all();
    deadline_.expires_after(kMoveWithin);
    deadline_.async_wait([stop_all](const boost::system::error_code& error) {
      if (!error) stop_all();
    });
  }
  void stop_parts(const std::string& text, const std::string& reason);
  void part_stopped() {
    if (--parts_running_ > 0) return;
    deadline_.cancel();
    stop_contexts();
  }
  void give_up_waiting();
  void stop_contexts() {
    ticks_.stop();
    io_.stop();
  }

  std::shared_ptr<spdlog::logger> log_;
  Companions companions_;
  boost::asio::io_context io_;
  boost::asio::io_context
      ticks_;  ///< ends before io_: what rooms posted holds them, and they hand out over io_
  Lanes lanes_;
  boost::asio::strand<boost::asio::io_context::executor_type> strand_;
  boost::asio::signal_set signals_;
  boost::asio::steady_timer deadline_;

  Outside outside_;
  bool had_terminal_;
  LiveLimits limits_;
  TrafficMetrics traffic_;
  SteadyTimekeeper timekeeper_;
  Lobby lobby_;
  RoomGuide guide_{lobby_};
  SessionEnvironment environment_;
  const std::shared_ptr<Doorman> doorman_ = std::make_shared<Doorman>();
  Acceptor acceptor_;
  RoomOpener opener_;
  RoomControl room_control_;
  std::optional<BanDesk> ban_desk_;
  Moderation moderation_;
  const Metrics metrics_;
  Operator operator_;
  AdminDoor admin_;
  std::string address_, admin_address_;
  // The strand's:
  std::set<std::string> rooms_running_;  ///< that have not reached the tick limit
  std::size_t parts_running_ = 0;        ///< once stopping: rooms and the acceptor
  bool stopping_ = false;
  bool parts_stop_ = false;  ///< and a cluster's rooms have had their time to go on elsewhere
  std::optional<GameRotation> rotation_;
  std::optional<ClusterDesk> cluster_;
};

}  // namespace woodlouse::server
