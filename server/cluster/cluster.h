// A host's part in its cluster: it owns the shard's rooms and writes their log, or follows the log of who
// does and stands by. Without nats.h in the build there is none: open() says so.
#pragma once

#include <spdlog/logger.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/access/claim.h"
#include "server/cluster/cluster_settings.h"
#include "server/cluster/host_table.h"
#include "server/room/tick_watcher.h"
#include "server/timing/cluster_figures.h"
#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

/// A room that another host has had, at the last tick that the log has of it.
struct RoomToGoOn {
  std::string name;
  std::shared_ptr<const map::Map> map;
  match::MatchSettings settings;
  match::MatchState state;
  std::vector<Claim> claims;
  std::string from;  ///< whose log, for people
};

class Cluster {
 public:
  /// Called on a thread of the cluster's; who is called hands it on and returns.
  struct Hooks {
    /// The shard is this host's: these go on here; none: the shard is new, its rooms begin.
    std::function<void(std::vector<RoomToGoOn> rooms)> take_over;
    /// It is another host's, also behind a hand_over(): no room of it may go on here. address: where it is;
    /// empty: not known.
    std::function<void(std::string address)> step_down;
    /// Somebody asks that they go on at another host, by its name; empty: at any. Whoever is asked holds
    /// them, says hand_over(), and ends them at step_down().
    std::function<void(std::string to)> move;
    /// The log of these rooms is another host's, and is followed.
    std::function<void(std::vector<std::string> rooms)> stands_by;
    /// The rooms that are here.
    std::function<std::vector<protocol::RoomEntry>()> census;
  };
  /// Of a host that only shows the rooms: it never owns them, and tells nobody of itself. Called likewise.
  struct Viewers {
    /// What the log tells of a room next: a recording's lines, without their newlines.
    std::function<void(const std::string& room, std::vector<std::string> lines)> lines;
    std::function<void(const std::string& room)> closed;
  };

  /// Waits for NATS. Errors: nobody is there, there is no log (`cluster init` makes it), this build has no
  /// NATS.
  static core::Expected<std::unique_ptr<Cluster>> open(ClusterSettings settings, Hooks hooks,
                                                       std::shared_ptr<spdlog::logger> log);
  static core::Expected<std::unique_ptr<Cluster>> open(ClusterSettings settings, Viewers viewers,
                                                       std::shared_ptr<spdlog::logger> log);
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;
  /// leave(), where it has not been.
  virtual ~Cluster() = default;

  /// Follows or takes over, from now on.
  virtual void start() = 0;
  /// From now on no room is said to be closed: it goes on elsewhere, at `to`, a host's name; empty: at any
  /// that stands by. Any thread.
  virtual void begin_leaving(const std::string& to) = 0;
  /// After begin_leaving(), when no room plays any more: they are another host's to go on with. Then, or when
  /// none has done so soon, step_down() follows; in that case they are this one's to begin anew. Any thread.
  virtual void hand_over() = 0;
  /// The rooms go on elsewhere, if somebody stands by: what they have told so far is stored, the others are
  /// told. No hook is called any more. Waits for that, half a second at most.
  virtual void leave() = 0;

  // Any thread; return at once:

  /// What writes the log of a room's next game. REQUIRES that its header has the map in it.
  [[nodiscard]] virtual std::unique_ptr<TickWatcher> watch(const std::string& room,
                                                           replay::Header header) = 0;
  /// Where a room of the shard is, if it is not here; nothing: not known.
  [[nodiscard]] virtual std::optional<std::string> elsewhere(std::string_view room) const = 0;
  /// Whether that room is the shard's, and soon will be somewhere.
  [[nodiscard]] virtual bool is_on_its_way(std::string_view room) const = 0;
  /// Those of other hosts, as these tell of them; of this host's shard none while they are here.
  [[nodiscard]] virtual std::vector<HostedRoom> rooms_elsewhere() const = 0;
  /// Addresses of other hosts at which its rooms may be found.
  [[nodiscard]] virtual std::vector<std::string> hosts() const = 0;
  [[nodiscard]] virtual ClusterFigures figures() const = 0;
  /// Where who is here is to go when this host leaves; `wanted`: if that one, by its name, stands by.
  /// Nothing: nobody stands by.
  [[nodiscard]] virtual std::optional<std::string> successor(const std::string& wanted = {}) const = 0;

 protected:
  Cluster() = default;
};

}  // namespace woodlouse::server
