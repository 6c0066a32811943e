// In a build without NATS.
#include "server/cluster/cluster_command.h"

namespace woodlouse::server {

int cluster_command(const ClusterErrand&, std::ostream&, std::ostream& err) {
  err << "woodlouse-server: cluster: this server was built without NATS\n"
         "      install libnats-dev and build it again with -DWOODLOUSE_CLUSTER=ON\n";
  return 1;
}

}  // namespace woodlouse::server
