#include "server/room/shown_game.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "shared/follow/shown_game.h"

namespace woodlouse::server {
namespace {

using protocol::EventKind;

static_assert(static_cast<int>(rules::EventKind::kRound) + static_cast<int>(EventKind::kGate) ==
              static_cast<int>(EventKind::kRound));

GameScene shown_game(const rules::Rules& rules, std::span<const state::Louse> lice) {
  GameScene scene{follow::shown_game(rules), {}};
  for (const state::Louse& louse : lice) scene.standings.push_back(rules.standing(louse.id));
  return scene;
}

}  // namespace

Scene scene_of(const match::Match& game, std::uint64_t ticks_a_frame) {
  assert(ticks_a_frame > 0);
  const auto lice = game.world().lice();
  Scene scene{
      game.tick(), game.tick() / ticks_a_frame, lice, game.world().terrain(), game.hash(), game.link(), {}};
  scene.wraps = game.world().parameters().edges == state::Edges::kWrap;
  if (game.rules() != nullptr) scene.game = shown_game(*game.rules(), lice);
  return scene;
}

protocol::Event shown_event(const rules::Event& event, const rules::Rules& rules) {
  protocol::Event shown_event;
  shown_event.tick = event.moment / rules::kMomentsPerTick;
  shown_event.kind =
      static_cast<EventKind>(static_cast<int>(EventKind::kGate) + static_cast<int>(event.kind));
  shown_event.id = event.louse;
  shown_event.moment = event.moment;
  std::copy(event.values.begin(), event.values.end(), shown_event.values.begin());
  for (auto& value : shown_event.values) {
    if (value == rules::kNone) value.reset();
  }
  if (event.kind != rules::EventKind::kRound) return shown_event;
  // A phase is told by name.
  shown_event.phase = follow::shown_phase(static_cast<rules::Phase>(event.values[1]));
  shown_event.values = {event.values[0], event.values[2], std::nullopt, std::nullopt};
  shown_event.table = follow::shown_table(rules);
  return shown_event;
}

}  // namespace woodlouse::server
