#include "server/cluster/cluster.h"

#include "server/cluster/node.h"

namespace woodlouse::server {

core::Expected<std::unique_ptr<Cluster>> Cluster::open(ClusterSettings settings, Hooks hooks,
                                                       std::shared_ptr<spdlog::logger> log) {
  auto node = std::make_unique<Node>(std::move(settings), std::move(hooks), std::move(log));
  if (auto connected = node->connect(); !connected) return tl::unexpected(connected.error());
  return node;
}

}  // namespace woodlouse::server
