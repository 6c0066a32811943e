#include "client/play/keyframe_verifier.h"

#include <vector>

#include "shared/state/louse.h"
#include "shared/state/state_hash.h"

namespace woodlouse::client {
namespace {

/// REQUIRES protocol::all_columns(): the louse's record, field by field. The decoder has checked the
/// integers.
state::Louse louse_of(const double* row) {
  state::Louse louse;
  louse.id = static_cast<state::LouseId>(row[0]);
  louse.phase = static_cast<state::Phase>(static_cast<std::uint32_t>(row[1]));
  louse.position = {row[2], row[3]};
  louse.velocity = {row[4], row[5]};
  louse.heading = {row[6], row[7]};
  louse.thrust = {row[8], row[9]};
  louse.flight_z = row[10];
  louse.flight_vz = row[11];
  louse.distance = row[12];
  louse.thrust_kind = static_cast<state::ThrustKind>(static_cast<std::uint32_t>(row[13]));
  louse.thrust_ticks = static_cast<std::uint32_t>(row[14]);
  return louse;
}

}  // namespace

std::string to_text(const KeyDifference& difference) {
  return "state DIFFERS at tick " + std::to_string(difference.tick) + ": the key says " +
         core::to_hex(difference.stated) + ", its rows give " + core::to_hex(difference.recomputed);
}

void KeyVerifier::take(const protocol::Frame& frame) {
  if (!frame.proof || !frame.hash) return;
  std::vector<state::Louse> lice;
  lice.reserve(frame.rows());
  for (std::size_t row = 0; row < frame.rows(); ++row)
    lice.push_back(louse_of(&frame.values[row * frame.columns]));
  const state::HashLink link{frame.proof->previous, frame.proof->inputs, frame.tick, frame.proof->generator};
  const std::uint64_t recomputed = state::state_hash(hasher_, link, lice);
  if (recomputed == *frame.hash) {
    ++verified_;
    hash_ = recomputed;
  } else if (!difference_) {
    difference_ = KeyDifference{frame.tick, *frame.hash, recomputed};
  }
}

}  // namespace woodlouse::client
