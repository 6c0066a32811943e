#include "client/play/keyframe_verifier.h"

#include <span>
#include <vector>

#include "shared/state/louse_fields.h"
#include "shared/state/state_hash.h"

namespace woodlouse::client {
std::string to_text(const KeyDifference& difference) {
  return "state DIFFERS at tick " + std::to_string(difference.tick) + ": the key says " +
         core::to_hex(difference.stated) + ", its rows give " + core::to_hex(difference.recomputed);
}

void KeyVerifier::take(const protocol::Frame& frame) {
  if (!frame.proof || !frame.hash) return;
  std::vector<state::Louse> lice;
  lice.reserve(frame.rows());
  for (std::size_t row = 0; row < frame.rows(); ++row)
    lice.push_back(state::louse_of(std::span(frame.values).subspan(row * frame.columns, frame.columns)));
  const state::HashLink& link = *frame.proof;
  // Before the first step that did something nobody is there, and of the link the generator alone is not 0.
  const bool is_beginning = lice.empty() && link == state::HashLink{.generator = link.generator};
  const std::uint64_t recomputed = is_beginning ? 0 : state::state_hash(hasher_, link, lice);
  if (recomputed == *frame.hash) {
    ++verified_;
    hash_ = recomputed;
  } else if (!difference_) {
    difference_ = KeyDifference{frame.tick, *frame.hash, recomputed};
  }
}

}  // namespace woodlouse::client
