// What a host knows of its cluster: the file of --cluster, and what the command line says of this host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/timing/clock.h"
#include "shared/core/error.h"

namespace woodlouse::server {

/// They live and move together: one log, one owner. As many as a server opens.
inline constexpr std::size_t kMostRoomsOfShard = 1024;

struct ClusterSettings {
  // The file's, the same on every host:
  std::string cluster = "woodlouse";  ///< its name, in every subject
  std::vector<std::string> nats;      ///< nats://HOST:PORT, one to 16
  std::string shard = "main";         ///< the rooms that live and move together
  std::uint32_t replicas = 1;         ///< of the log: 1, 3 or 5 of the NATS servers
  Duration batch = std::chrono::milliseconds(100);
  Duration silence = std::chrono::milliseconds(1000);  ///< of an owner, before another takes over
  Duration keep = std::chrono::hours(1);               ///< how long the log holds a batch
  bool is_strict = false;  ///< nobody is shown a tick before the log has it, and none is played meanwhile
  std::filesystem::path authority, certificate, key;  ///< PEM files of TLS; empty: plain
  std::filesystem::path credentials;                  ///< of NATS; empty: none
  // This host's:
  std::string host;      ///< its name
  std::string address;   ///< HOST:PORT at which clients reach it
  bool is_edge = false;  ///< it shows the rooms to who watches, and never plays them

  /// Subjects and the stream.
  [[nodiscard]] std::string log_subject() const { return "wl." + cluster + ".log." + shard; }
  [[nodiscard]] std::string stream() const { return "WL_" + cluster + "_" + shard; }
  /// Where an operator asks that the shard's rooms go on at another host.
  [[nodiscard]] std::string move_subject() const { return "wl." + cluster + ".move." + shard; }
  [[nodiscard]] std::string beat_subject(const std::string& of) const {
    return "wl." + cluster + ".beat." + of;
  }
  [[nodiscard]] std::string edge_subject(const std::string& of) const {
    return "wl." + cluster + ".edge." + of;
  }
};

/// Errors: FILE:LINE: field: what. The host's own part is left as it is.
core::Expected<ClusterSettings> read_cluster_settings(const std::filesystem::path& file);

/// Whether it can stand in a subject: letters, digits, - and _, 1 to 32 of them.
[[nodiscard]] bool is_cluster_name(const std::string& name);

}  // namespace woodlouse::server
