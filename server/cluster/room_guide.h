// Every room that a server knows of, for who asks it: those that are here, and in a cluster those of other
// hosts, as these tell of them. Each has a code by which it is joined, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/cluster/host_table.h"
#include "server/cluster/join_code.h"
#include "server/room/directory.h"

namespace woodlouse::server {

/// Any thread.
class RoomGuide final : public Directory {
 public:
  /// Of other hosts that it tells of; a host that told of more would be a broken one.
  static constexpr std::size_t kMostElsewhere = 1024;

  /// What a cluster knows; any thread.
  struct Cluster {
    std::string name, shard;  ///< of this host's rooms
    /// That are at other hosts, each with its address.
    std::function<std::vector<HostedRoom>()> rooms;
    /// Where a room of this host's shard is, if it is not here; the empty name: the first. Empty: it is about
    /// to go on; nothing: there is none.
    std::function<std::optional<std::string>(std::string_view room)> where;
  };

  /// here: outlives it.
  explicit RoomGuide(const Directory& here) : here_(&here) {}
  /// Those are here from now on; outlives it. Before another thread asks.
  void show(const Directory& here) { here_ = &here; }
  /// Before another thread asks.
  void use(Cluster cluster) { cluster_ = std::move(cluster); }

  /// By name, or by code where no room has that name.
  [[nodiscard]] std::shared_ptr<Door> find(std::string_view name) const override;
  /// Where a room is that find() does not know, `host:port`, by the same rule. Empty: it is about to go on;
  /// nothing: nobody knows it.
  [[nodiscard]] std::optional<std::string> elsewhere(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const override;
  /// With codes; those that are here come first.
  [[nodiscard]] protocol::Rooms list() const override;
  [[nodiscard]] std::uint64_t changes() const override;
  [[nodiscard]] std::string_view why_not_ready(Time now) const override { return here_->why_not_ready(now); }

 private:
  /// Those that are here have no address.
  [[nodiscard]] std::vector<HostedRoom> rooms() const;
  [[nodiscard]] std::vector<HostedRoom> rooms_elsewhere(const std::vector<HostedRoom>& here) const;
  [[nodiscard]] std::optional<HostedRoom> called(std::string_view name) const;

  const Directory* here_;
  Cluster cluster_;
};

}  // namespace woodlouse::server
