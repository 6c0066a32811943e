#include "client/play/stream_view.h"

#include <algorithm>
#include <cassert>

#include "shared/core/printable.h"
#include "shared/follow/shown_game.h"

namespace woodlouse::client {

Snapshot snapshot_of(const match::Match& match) {
  Snapshot snapshot{match.tick(), {}, {}};
  const rules::Rules* const rules = match.rules();
  if (rules != nullptr) snapshot.game = follow::shown_game(*rules);
  for (const state::Louse& louse : match.world().lice()) {
    LouseSample& sample = snapshot.lice[louse.id];
    sample.position = louse.position;
    sample.velocity = louse.velocity;
    sample.heading = louse.heading;
    sample.distance = louse.distance;
    sample.flight_z = louse.flight_z;
    if (rules == nullptr) continue;
    const rules::Standing standing = rules->standing(louse.id);
    sample.standing = {standing.score, standing.gate, standing.lap,
                       static_cast<std::int64_t>(standing.lap_start),
                       static_cast<std::int64_t>(standing.best_lap)};
  }
  return snapshot;
}

std::string to_text(const replay::Difference& difference) {
  return "state DIFFERS at tick " + std::to_string(difference.tick) + ": " + core::printable(difference.what);
}

void StreamView::begin(std::uint32_t tick_hz, std::uint32_t state_hz) {
  assert(tick_hz > 0 && state_hz > 0);
  follower_.begin_anew();
  ticks_a_part_ = std::max(1u, tick_hz / state_hz);
  ticks_a_picture_ = std::max(1u, tick_hz / kPicturesHz);
  pictured_.reset();
}

std::optional<Snapshot> StreamView::picture() {
  const std::uint64_t tick = match()->tick();
  // Behind a new keyframe it may stand further back than it was.
  if (pictured_ && tick >= *pictured_ && tick - *pictured_ < ticks_a_picture_) return std::nullopt;
  pictured_ = tick;
  return snapshot_of(*match());
}

}  // namespace woodlouse::client
