// The options of a server in a cluster, and the command `cluster`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "server/cluster/cluster_command.h"
#include "server/cluster/cluster_settings.h"
#include "shared/core/error.h"

namespace CLI {
class App;
}

namespace woodlouse::server {

struct ServeConfig;

/// As typed, before they are checked.
struct TypedCluster {
  std::optional<std::filesystem::path> file;
  std::optional<std::string> host, address;
  bool is_edge = false;
};
struct TypedClusterErrand {
  ClusterErrand errand;
  std::filesystem::path file;
};

void add_cluster_options(CLI::App& app, TypedCluster& typed);
/// Nothing: the server is alone. serve: what else it is asked. Errors: where = the option, or FILE:LINE:
/// field.
core::Expected<std::optional<ClusterSettings>> checked_cluster(const TypedCluster& typed,
                                                               const ServeConfig& serve);

/// `cluster` with its own commands, of which one must be given.
CLI::App* add_cluster_command(CLI::App& app, TypedClusterErrand& typed);
core::Expected<ClusterErrand> checked_cluster_errand(const TypedClusterErrand& typed);

}  // namespace woodlouse::server
