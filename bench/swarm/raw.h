// Connections that read and count bytes, whatever they are: the other end of a bare loop of sends.
#pragma once

#include <iosfwd>

#include "bench/swarm/options.h"
#include "shared/core/error.h"

namespace woodlouse::swarm {

/// options.bots connections until the other side ends them all, or for options.seconds; prints what came.
core::Expected<void> count_raw_bytes(std::ostream& out, const Options& options);

}  // namespace woodlouse::swarm
