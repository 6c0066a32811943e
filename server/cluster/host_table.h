// What the hosts of a cluster say of themselves, many times a second: who owns the shard, where its clients
// are to go, whether he goes; and which edges show it. Nothing here decides who may write the log: that the
// log does; a beat only spares the waiting. Pure: times are arguments. Any thread, under its lock.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/cluster/batch.h"
#include "server/timing/clock.h"
#include "shared/core/error.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// An edge's is one, too, of a host that owns nothing.
struct Beat {
  std::string host;
  std::string address;  ///< for clients; empty, an edge's alone: nobody is sent there
  std::string shard;
  bool owns = false;
  bool leaves = false;          ///< it goes, and hands its rooms over
  std::string to{};             ///< to which host; empty: whoever is next
  bool ready = false;           ///< of a follower: it has all of the log and could go on with it, or shows it
  std::uint64_t process = 0;    ///< made by chance: tells two that have one name
  Writer writer;                ///< where it owns: as whom; else the one it follows
  std::uint64_t sequence = 0;   ///< of the log: acknowledged to an owner, read by a follower
  std::uint64_t silent_ms = 0;  ///< of a follower: for how long it has heard nothing of the owner
  std::optional<bool> strict{};  ///< its mode is strict; nothing: an older build's, which does not say
  /// An owner's; nothing: those that it told last.
  std::optional<std::vector<protocol::RoomEntry>> rooms{};
  friend bool operator==(const Beat&, const Beat&) = default;
};

/// What an operator asks of a shard's owner.
struct MoveOrder {
  std::string from;  ///< of that host, which is to have no room any more; empty: of any
  std::string to;    ///< to that one; empty: to whoever is next
};

std::string to_text(const MoveOrder& order);
core::Expected<MoveOrder> move_order_from(std::string_view text);

std::string to_text(const Beat& beat);
/// Members that this build does not know are passed over: hosts of a cluster have newer builds one by one.
/// Errors: it is none; what NATS brings came from outside.
core::Expected<Beat> beat_from(std::string_view text);

/// A room, with the address of the host that has it.
struct HostedRoom {
  std::string shard;
  protocol::RoomEntry room;
};

class HostTable {
 public:
  /// Of which nothing is known that is older. But while nobody is heard, this host itself neither, and for as
  /// long after that, it is this host that hears nothing: the others may well be where they were.
  static constexpr Duration kForgottenAfter = std::chrono::seconds(5);
  static constexpr Duration kDeafAfter = std::chrono::seconds(2);
  static constexpr std::size_t kMostHosts = 256;
  static constexpr std::size_t kMostEdges = 1024;

  HostTable(std::string own_host, std::string shard, std::uint64_t process)
      : own_(std::move(own_host)), shard_(std::move(shard)), process_(process) {}

  /// Another host's; of other shards only where their rooms are is asked for. True: it is the first of its
  /// process.
  bool take(Beat beat, Time now);
  /// Another edge's; two may have one name. True: likewise.
  bool take_edge(Beat beat, Time now);
  [[nodiscard]] std::uint64_t process() const { return process_; }

  /// When that writer was heard last.
  [[nodiscard]] Time heard(const Writer& writer) const;
  /// Whether that owner's mode is strict; nothing: it does not say, or is not heard.
  [[nodiscard]] std::optional<bool> is_strict(const Writer& writer) const;
  /// To which host it has said that its rooms go; empty: whoever is next. Nothing: it stays.
  [[nodiscard]] std::optional<std::string> leaves(const Writer& writer) const;
  /// How many are to try before this host: those that could go on, by name. None: one of them has heard of
  /// the owner within half of `silence`.
  [[nodiscard]] std::optional<std::size_t> place_in_line(Duration silence, Time now) const;
  /// Another host of this name was heard lately.
  [[nodiscard]] bool has_twin(Time now) const;
  /// That anybody has told of.
  [[nodiscard]] std::uint64_t highest_epoch() const;
  /// Where the owner's clients go; nothing: no owner is heard, or it goes.
  [[nodiscard]] std::optional<Beat> owner(Time now, Duration within = std::chrono::seconds(1)) const;
  /// A host, not this one, that follows, has all, and was heard just now. wanted: that one; empty: any.
  [[nodiscard]] std::optional<Beat> successor(Time now, std::string_view wanted = {}) const;
  /// Addresses of the others that are not forgotten.
  [[nodiscard]] std::vector<std::string> addresses(Time now) const;
  /// The same of edges that show the shard, from another one on each time: who is sent on from one that ends
  /// is not sent to the same one as all others.
  [[nodiscard]] std::vector<std::string> edge_addresses(Time now) const;
  [[nodiscard]] std::vector<Beat> hosts(Time now) const;
  [[nodiscard]] std::vector<Beat> edges(Time now) const;
  /// Of all shards, as their owners have told of them; of one that is silent or goes, too, till another one
  /// is heard or it is forgotten.
  [[nodiscard]] std::vector<HostedRoom> rooms(Time now) const;

 private:
  struct Known {
    Beat beat;
    Time at{};
  };
  void hear(Time now);
  [[nodiscard]] bool is_forgotten(const Known& known, Time now) const;

  const std::string own_, shard_;
  const std::uint64_t process_;
  Time twin_at_{};      ///< when another process of this name was heard
  Time heard_at_{};     ///< whoever it was, last
  Time hears_since_{};  ///< without a pause
  mutable std::mutex mutex_;
  std::map<std::string, Known, std::less<>> hosts_;
  std::map<std::string, Known, std::less<>> strangers_;  ///< of other shards
  std::map<std::uint64_t, Known> edges_;                 ///< of all shards, by process
  mutable std::uint64_t turn_ = 0;                       ///< of who asked for edges last
};

}  // namespace woodlouse::server
