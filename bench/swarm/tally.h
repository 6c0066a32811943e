// What clients got while they were measured.
#pragma once

#include <cstdint>

#include "bench/swarm/samples.h"

namespace woodlouse::swarm {

struct Tally {
  std::uint64_t distinct_ticks = 0;
  std::uint64_t missed = 0;  ///< frames that were due between two that came
  std::uint64_t bytes = 0;   ///< received
  std::uint64_t bytes_sent = 0;
  std::uint64_t inputs = 0;
  std::uint64_t acks = 0;
  Samples input_to_ack;
  Samples frame_gaps;

  void add(const Tally& other) {
    distinct_ticks += other.distinct_ticks;
    missed += other.missed;
    bytes += other.bytes;
    bytes_sent += other.bytes_sent;
    inputs += other.inputs;
    acks += other.acks;
    input_to_ack.add(other.input_to_ack);
    frame_gaps.add(other.frame_gaps);
  }
};

}  // namespace woodlouse::swarm
