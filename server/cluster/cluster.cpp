#include "server/cluster/cluster.h"

#include "server/cluster/node.h"

namespace woodlouse::server {

namespace {

core::Expected<std::unique_ptr<Cluster>> connected(std::unique_ptr<Node> node) {
  if (auto connected = node->connect(); !connected) return tl::unexpected(connected.error());
  return node;
}

}  // namespace

core::Expected<std::unique_ptr<Cluster>> Cluster::open(ClusterSettings settings, Hooks hooks,
                                                       std::shared_ptr<spdlog::logger> log) {
  return connected(std::make_unique<Node>(std::move(settings), std::move(hooks), std::move(log)));
}

core::Expected<std::unique_ptr<Cluster>> Cluster::open(ClusterSettings settings, Viewers viewers,
                                                       std::shared_ptr<spdlog::logger> log) {
  return connected(std::make_unique<Node>(std::move(settings), std::move(viewers), std::move(log)));
}

}  // namespace woodlouse::server
