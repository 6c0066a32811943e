// What a crowd did to those beside it, as lines for people and for the tables made of them.
#pragma once

#include <iosfwd>

#include "bench/swarm/options.h"
#include "bench/swarm/swarm.h"

namespace woodlouse::swarm {

/// seconds: how long it measured. True when all joined and none was lost.
bool print_crowd_report(std::ostream& out, const Options& options, const Swarm& swarm, double seconds);

}  // namespace woodlouse::swarm
