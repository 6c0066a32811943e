#include "shared/rules/race.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include "shared/state/step_events.h"

namespace woodlouse::rules {
namespace {

/// Nothing of these lets the way be a cubic: its velocity jumps within.
constexpr state::StepEvents kJumps = state::kMetWall | state::kLanded | state::kStopped;
constexpr double kClear = 0.8, kSlack2 = 1e-6;  // of a distance's square; [m^2] of it: far above roundings

}  // namespace

Race::Race(const map::Map& map, std::uint32_t tick_hz)
    : Race(map, tick_hz, std::uint64_t{map.definition.modes.race->round_s} * tick_hz) {}

Race::Race(const map::Map& map, std::uint32_t tick_hz, std::uint64_t play)
    : Rules(state::Mode::kRace, map, tick_hz,
            {0, play, std::uint64_t{map.definition.modes.race->podium_s} * tick_hz}),
      mode_(*map.definition.modes.race),
      images_(images_of(map)) {
  assert(mode_.gates.size() >= map::kMinGates && mode_.gates.size() <= map::kMaxGates && mode_.laps >= 1);
}

std::span<const map::SpawnPoint> Race::spawns() const {
  return mode_.spawns.empty() ? Rules::spawns() : std::span(mode_.spawns);
}

std::optional<Start> Race::last_gate(state::LouseId louse) const {
  const Player* player = players_.find(louse);
  if (player == nullptr || !player->has_gate) return std::nullopt;
  return player->gate_start;
}

std::int64_t Race::score(const Player& player) const { return static_cast<std::int64_t>(player.best_run); }

Standing Race::standing(state::LouseId louse) const {
  const Player* player = players_.find(louse);
  if (player == nullptr) return {};
  return {score(*player), player->next, player->lap, player->is_running ? player->lap_start : 0,
          player->best_lap};
}

std::vector<TableRow> Race::table() const {
  std::vector<const Player*> order;
  for (const Player& player : players_) order.push_back(&player);
  std::sort(order.begin(), order.end(), [](const Player* a, const Player* b) {
    const auto key = [](const Player& p) {
      return std::tuple(p.best_run == 0, p.best_run, p.best_run_at, p.id);
    };
    return key(*a) < key(*b);
  });
  std::vector<TableRow> rows;
  for (const Player* player : order) rows.push_back({player->id, score(*player)});
  return rows;
}

/// Of a run that ended at that moment, as if it were the louse's best; 1: the best of the round.
std::uint32_t Race::rank(state::LouseId louse, Moment run, Moment at) const {
  const auto key = std::tuple(run, at, louse);
  return 1 +
         static_cast<std::uint32_t>(std::count_if(players_.begin(), players_.end(), [&](const Player& other) {
           return other.best_run != 0 && std::tuple(other.best_run, other.best_run_at, other.id) < key;
         }));
}

Race::Player Race::new_player(state::LouseId louse) const {
  Player player;
  player.id = louse;
  player.splits.resize(mode_.gates.size());
  player.best_splits.resize(mode_.gates.size());
  return player;
}

void Race::on_join(state::LouseId louse) { players_.add(new_player(louse)); }

void Race::on_leave(state::LouseId louse) { players_.remove(louse); }

void Race::stop_clock(Player& player) {
  player.next = player.lap = 0;
  player.clear2 = 0.0;
  player.lap_start = player.run_start = 0;
  player.is_running = player.is_from_spawn = player.is_practice = false;
  std::fill(player.splits.begin(), player.splits.end(), Moment{0});
}

void Race::on_respawn(state::LouseId louse) {
  Player* player = players_.find(louse);
  assert(player != nullptr);
  stop_clock(*player);
  player->is_at_spawn = true;
  player->has_gate = false;
}

void Race::on_respawn_at_gate(state::LouseId louse) {
  Player* player = players_.find(louse);
  assert(player != nullptr && player->has_gate);
  player->is_practice = true;
}

void Race::on_round(Step&) {
  for (Player& player : players_) {
    stop_clock(player);
    player.best_lap = player.best_run = player.best_run_at = 0;
    std::fill(player.best_splits.begin(), player.best_splits.end(), Moment{0});
  }
}

/// Its image that is nearest.
inline map::Gate Race::shown_from(core::Vec2 place, const map::Gate& gate) const {
  if (!images_.wraps()) return gate;
  const core::Vec2 shift = images_.shift(place, 0.5 * (gate.a + gate.b));
  return {gate.a + shift, gate.b + shift, gate.in_air};
}

void Race::before_step(const physics::World& world) {
  const std::span<const state::Louse> lice = world.lice();
  starts_.resize(lice.size());
  for (std::size_t k = 0; k < lice.size(); ++k) {
    starts_[k].position = lice[k].position;
    starts_[k].velocity = lice[k].velocity;
    starts_[k].is_flying = lice[k].phase == state::Phase::kFlying;
  }
}

void Race::judge(Step& step) {
  if (round().phase != Phase::kPlay) return;
  const std::span<const state::Louse> lice = step.world.lice();
  const std::span<const state::StepEvents> met = step.world.events();
  assert(starts_.size() == lice.size());
  auto player = players_.begin();
  for (std::size_t k = 0; k < lice.size(); ++k) {
    while (player != players_.end() && player->id < lice[k].id) ++player;
    if (player == players_.end()) return;
    if (player->id != lice[k].id) continue;
    const core::Vec2 came = starts_[k].position - player->looked_at;
    const core::Vec2 went = lice[k].position - player->looked_at;
    // Nearly all: neither end of the step is over their gate's line.
    if (std::max(core::dot(came, came), core::dot(went, went)) < player->clear2) continue;
    look(*player, starts_[k], lice[k], step, (met[k] & kJumps) == 0);
  }
}

/// Whether it goes through its gate; and how far it may go from where it was until that can be so.
void Race::look(Player& player, const Start& start, const state::Louse& louse, const Step& step,
                bool is_smooth) {
  assert(player.id == louse.id);
  const map::Gate gate = shown_from(start.position, mode_.gates[player.next]);
  const core::Vec2 along = gate.b - gate.a;
  const double side = side_of(gate, start.position);
  const double line2 = side * side / core::dot(along, along);
  const double image2 = images_.margin2(start.position, 0.5 * (gate.a + gate.b));
  player.looked_at = start.position;
  player.clear2 = kClear * std::min(line2, image2) - kSlack2;
  const core::Vec2 end = images_.nearest(start.position, louse.position);
  if (!(side < 0.0 && side_of(gate, end) >= 0.0)) return;
  drive(player, start, louse,
        {start.position, start.velocity, end, louse.velocity, step.world.step_seconds(), is_smooth},
        step.tick);
}

/// Through as many gates as the step led, one after the other.
void Race::drive(Player& player, const Start& start, const state::Louse& louse, Way way, std::uint64_t tick) {
  const bool is_flying = start.is_flying || louse.phase == state::Phase::kFlying;
  double last = -1.0;
  for (std::size_t passed = 0; passed < mode_.gates.size(); ++passed) {
    const map::Gate gate = shown_from(start.position, mode_.gates[player.next]);
    const std::optional<double> fraction = crossing(gate, way);
    if (!fraction || !(*fraction > last) || (gate.in_air && !is_flying)) return;
    last = *fraction;
    pass(player, moment_of(tick, *fraction));
    player.gate_start = {louse.position, louse.velocity, false};
    player.has_gate = true;
    note_change();
  }
}

void Race::pass(Player& player, Moment moment) {
  const std::uint32_t gate = player.next;
  player.next = (gate + 1) % static_cast<std::uint32_t>(mode_.gates.size());
  player.clear2 = 0.0;
  if (gate == 0) {
    if (player.is_running) return end_lap(player, moment);
    player.is_running = true;
    player.is_from_spawn = player.is_at_spawn;
    player.is_at_spawn = false;
    player.lap_start = player.run_start = moment;
    say({EventKind::kGate, player.id, moment, {0, 0, 0, kNone}});
    return;
  }
  const Moment split = moment - player.lap_start;
  const Moment best = player.best_splits[gate];
  player.splits[gate] = split;
  say({EventKind::kGate,
       player.id,
       moment,
       {gate, player.lap, static_cast<std::int64_t>(split),
        best == 0 ? kNone : static_cast<std::int64_t>(split) - static_cast<std::int64_t>(best)}});
}

/// Through the first gate again; the next lap begins there.
void Race::end_lap(Player& player, Moment moment) {
  const Moment time = moment - player.lap_start;
  const Moment best = player.best_lap;
  player.splits[0] = time;
  say({EventKind::kGate,
       player.id,
       moment,
       {0, player.lap, static_cast<std::int64_t>(time),
        best == 0 ? kNone : static_cast<std::int64_t>(time) - static_cast<std::int64_t>(best)}});
  const bool is_best = !player.is_practice && (best == 0 || time < best);
  if (is_best) {
    player.best_lap = time;
    player.best_splits = player.splits;
  }
  say({EventKind::kLap, player.id, moment, {player.lap, static_cast<std::int64_t>(time), is_best, 0}});
  std::fill(player.splits.begin(), player.splits.end(), Moment{0});
  player.lap_start = moment;
  if (++player.lap < mode_.laps) return;
  const Moment run = moment - player.run_start;
  if (!player.is_practice) {
    if (player.best_run == 0 || run < player.best_run) {
      player.best_run = run;
      player.best_run_at = moment;
    }
    say({EventKind::kRun,
         player.id,
         moment,
         {static_cast<std::int64_t>(run), rank(player.id, run, moment), player.is_from_spawn, 0}});
  }
  player.lap = 0;
  player.run_start = moment;
  player.is_from_spawn = player.is_practice = false;
}

void Race::write(StateWriter& out) const {
  out.put(static_cast<std::uint32_t>(players_.size()));
  for (const Player& player : players_) {
    const Start& start = player.gate_start;
    out.put(
        player.id, static_cast<std::uint8_t>(player.next),
        static_cast<std::uint8_t>(player.is_running | player.is_at_spawn << 1 | player.is_from_spawn << 2 |
                                  player.is_practice << 3 | player.has_gate << 4),
        player.lap, player.lap_start, player.run_start, player.best_lap, player.best_run, player.best_run_at,
        start.position.x, start.position.y, start.velocity.x, start.velocity.y);
    for (std::size_t gate = 0; gate < mode_.gates.size(); ++gate)
      out.put(player.splits[gate], player.best_splits[gate]);
  }
}

bool Race::read(StateReader& in, std::span<const state::LouseId> ids) {
  players_.clear();
  const std::size_t gates = mode_.gates.size();
  const std::size_t count = in.get_count(4 + 1 + 1 + 4 + 5 * 8 + 4 * 8 + gates * 16);
  for (std::size_t k = 0; k < count; ++k) {
    Player player = new_player(in.get<std::uint32_t>());
    player.next = in.get<std::uint8_t>();
    const auto flags = in.get<std::uint8_t>();
    player.is_running = flags & 1u;
    player.is_at_spawn = flags & 2u;
    player.is_from_spawn = flags & 4u;
    player.is_practice = flags & 8u;
    player.has_gate = flags & 16u;
    player.lap = in.get<std::uint32_t>();
    for (Moment* moment :
         {&player.lap_start, &player.run_start, &player.best_lap, &player.best_run, &player.best_run_at})
      *moment = in.get<std::uint64_t>();
    core::Vec2& position = player.gate_start.position;
    core::Vec2& velocity = player.gate_start.velocity;
    for (double* value : {&position.x, &position.y, &velocity.x, &velocity.y}) *value = in.get_bits();
    for (std::size_t gate = 0; gate < gates; ++gate) {
      player.splits[gate] = in.get<std::uint64_t>();
      player.best_splits[gate] = in.get<std::uint64_t>();
    }
    const bool stands_on_map = map().terrain->domain().contains(position.x, position.y) || !player.has_gate;
    const bool is_slow = core::dot(velocity, velocity) <= 1e12;
    if (k >= ids.size() || player.id != ids[k] || flags >= 32 || player.next >= gates ||
        player.lap >= mode_.laps || !stands_on_map || !is_slow)
      return false;
    players_.add(std::move(player));
  }
  return count == ids.size();
}

}  // namespace woodlouse::rules
