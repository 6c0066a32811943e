// The server's part in a cluster: opens the rooms that are its own now, with what the log tells of them, and
// closes those that are another host's.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/strand.hpp>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "server/cluster/cluster.h"
#include "server/cluster/room_guide.h"
#include "server/config.h"
#include "server/relay/relay.h"
#include "server/room/lanes.h"
#include "server/room/lobby.h"
#include "server/room/start.h"
#include "server/timing/live_limits.h"
#include "server/timing/timekeeper.h"
#include "shared/core/error.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

struct SessionEnvironment;

/// The server's strand, where nothing else is said.
class ClusterDesk {
 public:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;
  struct Rooms {
    std::function<core::Expected<void>()> open_missing;  ///< those of the command line that are not here
    std::function<core::Expected<void>(const std::string& name, Start start)> open;
    std::function<void(const std::string& name)> closed;
    std::function<void(const std::string& why)> fail;  ///< ends the server
  };

  /// Where rooms that are only shown live.
  struct Stage {
    boost::asio::io_context& ticks;
    const Lanes& lanes;
    Timekeeper& timekeeper;
  };

  /// All outlive it.
  ClusterDesk(Strand strand, Lobby& lobby, const LiveLimits& limits, Stage stage, Rooms rooms,
              std::shared_ptr<spdlog::logger> log)
      : strand_(std::move(strand)),
        lobby_(lobby),
        limits_(limits),
        stage_(stage),
        rooms_(std::move(rooms)),
        log_(std::move(log)) {}

  /// Before the threads run; waits for NATS. lines, web_url: where this host's clients come. Of the two ports
  /// the others are told the web one, where there is one without TLS: it takes lines as well as pages.
  core::Expected<void> open(const ServeConfig& config, const std::string& lines, const std::string& web_url);
  /// Rooms begin, here or elsewhere, from now on.
  void start() { cluster_->start(); }
  /// What is said to who is here when the server stops; rooms are not closed any more, but go on elsewhere.
  protocol::Bye begin_leaving(const protocol::Bye& otherwise);
  /// Has the rooms go on at another host; gone: once they do. False, and nothing done: they are not here, or
  /// nobody stands by.
  bool move_away(std::function<void()> gone);
  /// Any thread, when no room is here any more.
  void leave() { cluster_->leave(); }
  /// Where a room is that is not here; empty: it is about to go on; nothing: it is none of the cluster's. Any
  /// thread.
  [[nodiscard]] std::optional<std::string> elsewhere(std::string_view room) const {
    if (auto address = cluster_->elsewhere(room)) return address;
    return cluster_->is_on_its_way(room) ? std::optional<std::string>("") : std::nullopt;
  }
  /// Who comes is told of the cluster's other hosts and their rooms, too. Before the threads run.
  void guide(RoomGuide& guide, SessionEnvironment& sessions) const;
  /// The rooms are here. Any thread.
  [[nodiscard]] bool owns() const { return owns_; }
  /// Any thread.
  [[nodiscard]] Cluster& cluster() { return *cluster_; }

 private:
  core::Expected<void> open_edge(const ServeConfig& config, ClusterSettings settings);
  [[nodiscard]] Cluster::Hooks hooks();
  void stand_by(const std::vector<std::string>& rooms);
  void take_over(std::vector<RoomToGoOn> rooms);
  void step_down(const std::string& address);
  bool move(const std::string& to);
  [[nodiscard]] Start start_of(RoomToGoOn room) const;

  Strand strand_;
  Lobby& lobby_;
  const LiveLimits& limits_;
  const Stage stage_;
  const Rooms rooms_;
  const std::shared_ptr<spdlog::logger> log_;
  std::optional<Relay> relay_;  ///< of an edge
  std::unique_ptr<Cluster> cluster_;
  std::string name_, shard_;         ///< of the cluster
  std::set<std::string> own_rooms_;  ///< of the command line
  std::string others_told_;          ///< of those, which the cluster does not play
  std::atomic<bool> owns_{false};
  std::size_t rooms_left_ = 0;  ///< that are to stand before the log is handed over
  std::string went_to_;         ///< where the rooms went from here; empty: nowhere, or it is not known
  std::function<void()> gone_;  ///< who waits for them to be another host's
};

}  // namespace woodlouse::server
