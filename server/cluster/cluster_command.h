// `woodlouse-server cluster`: what an operator does with a cluster's log: make it, look at it, prove it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>

#include "server/cluster/cluster_settings.h"

namespace woodlouse::server {

struct ClusterErrand {
  enum class Action : std::uint8_t {
    kInit,    ///< makes the shard's log, once
    kStatus,  ///< who owns it, who stands by, what is in it
    kMove,    ///< has its rooms go on at another host
    kDrain,   ///< has them go on elsewhere than at one host, which takes none any more
    kFsck,    ///< reads all of it, re-runs every room, names every hole
  };
  Action action = Action::kStatus;
  ClusterSettings settings;
  std::string host;           ///< kMove: to that one, empty: to whoever is next; kDrain: which
  std::filesystem::path out;  ///< kFsck: the folder of the joined recordings; empty: none are written
};

/// Exit code: 0 fine; 1 NATS does not answer, or the log is not as it should be.
int cluster_command(const ClusterErrand& errand, std::ostream& out, std::ostream& err);

}  // namespace woodlouse::server
