// How a host's part in its cluster stands, as of one look; counts are since the server began.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "server/timing/clock.h"

namespace woodlouse::server {

struct ClusterFigures {
  std::string shard;
  bool owns = false;           ///< its rooms are this host's
  bool ready = false;          ///< it stands by, and could go on with them
  bool differs = false;        ///< what it re-runs is not what the log says
  bool connected = false;      ///< to NATS
  std::uint64_t sequence = 0;  ///< of the log: the last batch stored, or read
  std::uint64_t waiting = 0;   ///< batches of this host that are not acknowledged
  Duration unacknowledged{};   ///< for how long none of them was
  std::uint64_t stored = 0;    ///< batches of this host
  std::uint64_t takeovers = 0, fenced = 0, holes = 0;
  // Other hosts of the shard that are heard:
  std::size_t owners = 0, standing_by = 0, others = 0;
};

}  // namespace woodlouse::server
