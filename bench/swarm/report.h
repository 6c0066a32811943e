// What a swarm measured, as lines for people and for bench/results.
#pragma once

#include <iosfwd>

#include "bench/swarm/options.h"
#include "bench/swarm/swarm.h"

namespace woodlouse::swarm {

/// seconds: how long it measured. True when every bot joined and none was lost.
bool print_report(std::ostream& out, const Options& options, const Swarm& swarm, double seconds);

}  // namespace woodlouse::swarm
