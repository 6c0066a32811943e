// In a build without NATS.
#include "server/cluster/cluster.h"

namespace woodlouse::server {

namespace {

tl::unexpected<core::Error> missing() {
  return core::fail("--cluster", "this server was built without NATS",
                    "install libnats-dev and build it again with -DWOODLOUSE_CLUSTER=ON");
}

}  // namespace

core::Expected<std::unique_ptr<Cluster>> Cluster::open(ClusterSettings, Hooks,
                                                       std::shared_ptr<spdlog::logger>) {
  return missing();
}

core::Expected<std::unique_ptr<Cluster>> Cluster::open(ClusterSettings, Viewers,
                                                       std::shared_ptr<spdlog::logger>) {
  return missing();
}

}  // namespace woodlouse::server
