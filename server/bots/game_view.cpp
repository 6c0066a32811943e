#include "server/bots/game_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace woodlouse::server::bots {

std::size_t GameView::find(state::LouseId louse) const {
  const auto found =
      std::lower_bound(lice.begin(), lice.end(), louse,
                       [](const state::Louse& one, state::LouseId wanted) { return one.id < wanted; });
  return found != lice.end() && found->id == louse ? static_cast<std::size_t>(found - lice.begin())
                                                   : lice.size();
}

void look(const match::Match& game, GameView& out) {
  const auto lice = game.world().lice();
  out.tick = game.tick();
  out.lice.assign(lice.begin(), lice.end());
  out.gates.clear();
  out.crumbs.clear();
  out.place = {};
  out.holder = 0;
  out.round = {};
  const rules::Rules* rules = game.rules();
  if (rules == nullptr) return;
  out.round = rules->round();
  for (const state::Louse& louse : lice) out.gates.push_back(rules->standing(louse.id).gate);
  for (const rules::ShownCrumb& crumb : rules->shown_crumbs()) {
    if (crumb.value != 0) out.crumbs.push_back({crumb.position, crumb.value});
  }
  if (const auto hill = rules->shown_hill()) {
    const map::HillPlace& place = game.map().definition.modes.hill->places[hill->place];
    out.place = {place.at, place.radius};
    out.holder = hill->holder;
  }
}

void Sight::look(const match::Match& game) {
  const std::uint32_t tick_hz = game.settings().tick_hz;
  const std::uint64_t every = (tick_hz + kFramesPerSecond - 1) / kFramesPerSecond;  // no more than that
  if (game.tick() % every != 0) return;
  const auto old = static_cast<std::uint64_t>(std::ceil(kOldest * tick_hz)) + every;
  GameView frame;
  while (!frames_.empty() && frames_.front().tick + old < game.tick()) {
    frame = std::move(frames_.front());  // its memory
    frames_.pop_front();
  }
  bots::look(game, frame);
  frames_.push_back(std::move(frame));
}

const GameView* Sight::before(std::uint64_t tick, std::uint64_t ticks) const {
  const GameView* seen = nullptr;
  for (const GameView& frame : frames_) {
    if (frame.tick + ticks <= tick) seen = &frame;
  }
  return seen;
}

}  // namespace woodlouse::server::bots
