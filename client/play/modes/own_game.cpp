#include "client/play/modes/own_game.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "client/play/modes/goal.h"

namespace woodlouse::client {

void OwnGame::take(const protocol::Hello& hello) {
  has_records_ = std::find(hello.features.begin(), hello.features.end(), "records") != hello.features.end();
}

void OwnGame::take(const protocol::Welcome& welcome) {
  map_.reset();
  run_.forget();
  gate_.forget();
  marks_.clear();
  author_ms_ = author_ms_of(welcome.rules);
}

void OwnGame::begin(std::shared_ptr<const map::Map> map, std::uint32_t tick_hz, state::Mode mode) {
  assert(map != nullptr);
  map_ = std::move(map);
  mode_ = mode;
  ghosts_.begin(map_, tick_hz, mode);
  if (mode == state::Mode::kRace)
    for (const protocol::Board board : protocol::kBoards) ask_for_ghost(board);
}

void OwnGame::take(const protocol::Event& event, const protocol::Welcome& welcome, Pilot* pilot,
                   core::Time now) {
  using protocol::EventKind;
  run_.event(event, welcome.id, welcome.tick_hz, now);
  if (pilot == nullptr) return;
  if (event.kind == EventKind::kRecord)
    ask_for_ghost(event.values[1].value_or(0) != 0 ? protocol::Board::kBots : protocol::Board::kPeople);
  if (event.id != pilot->id()) return;
  if (event.kind == EventKind::kLapDone)
    pilot->lap(static_cast<std::uint64_t>(std::max<std::int64_t>(0, event.values[1].value_or(0))));
  if (event.kind == EventKind::kFell)
    pilot->steering().reset();  // a cruise would lead on from the next spawn
  if (event.kind != EventKind::kRespawned && event.kind != EventKind::kReturned) return;
  pilot->respawned();
  if (auto drive = pilot->take_drive()) ghosts_.add_drive(std::move(*drive));
}

void OwnGame::update(const Pilot& pilot, const LouseSample& louse, double tick, core::Time now) {
  run_.observe(louse.standing);
  if (map_ == nullptr) return;
  marks_ = ghosts_.marks(pilot.since_spawn(), run_.run_start(), tick);
  const terrain::Rectangle& d = map_->terrain->domain();
  const bool wraps = map_->definition.physics.edges == state::Edges::kWrap;
  const rules::Images images(wraps ? core::Vec2{d.x_max - d.x_min, d.y_max - d.y_min} : core::Vec2{});
  if (const auto lap = gate_.observe(louse, images, now)) run_.own_lap(*lap, gate_.is_best(), now);
}

std::string OwnGame::set_gate(const LouseSample& louse, core::Vec2 heading, core::Time now) {
  if (mode_ != state::Mode::kRoam) return "a gate of one's own (B) is for rooms without rules";
  gate_.set(louse, heading, now);
  return "your own gate: drive through it again, the clock runs";
}

}  // namespace woodlouse::client
