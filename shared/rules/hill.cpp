#include "shared/rules/hill.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "shared/rules/bump.h"
#include "shared/state/step_events.h"

namespace woodlouse::rules {
namespace {

constexpr std::uint64_t kWarning = 5, kBlame = 3, kReward = 3;   // [s]
constexpr std::uint64_t kLongestRound = 900, kLongestHolds = 3;  // [s], times what wins
constexpr std::size_t kMostTold = 4;                             // bumps a tick
constexpr double kToldImpulse = 0.25;  // what is less is pressing, and no event [m/s]
constexpr std::uint64_t kMostHeld = std::uint64_t{1} << 53;
constexpr double kMaxDistance = 1e15;  // [m]

// Places do not change in a bump, so that two who press against each other would sink into each other, by
// what a bump that loses energy leaves of each tick's push. Who is that deep in, and comes on no faster than
// a push of two ticks makes it, is thrown back as fast.
constexpr double kDeep = 0.9;                  // of their distance
constexpr double kThrownBack = 1.0 - 0x1p-20;  // restitution: all but rounding, and never more

constexpr RoundLengths lengths_of(const map::HillMode& mode, std::uint64_t tick_hz) {
  return {kCountdown * tick_hz, std::max(kLongestRound, kLongestHolds * mode.hold_s) * tick_hz,
          mode.podium_s * tick_hz};
}

}  // namespace

Hill::Hill(const map::Map& map, std::uint32_t tick_hz)
    : Rules(state::Mode::kHill, map, tick_hz, lengths_of(*map.definition.modes.hill, tick_hz)),
      mode_(*map.definition.modes.hill),
      images_(images_of(map)) {
  assert(!mode_.places.empty() && mode_.places.size() <= map::kMaxPlaces && mode_.hold_s >= 1);
  if (mode_.bump_radius > 0.0) crowd_.emplace(map.terrain->domain(), images_, 2.0 * mode_.bump_radius);
}

bool Hill::is_out(state::LouseId louse) const {
  const Player* player = players_.find(louse);
  return player != nullptr && player->out != 0;
}

Standing Hill::standing(state::LouseId louse) const {
  const Player* player = players_.find(louse);
  return player != nullptr ? Standing{.score = static_cast<std::int64_t>(player->held)} : Standing{};
}

std::vector<TableRow> Hill::table() const {
  std::vector<const Player*> order;
  for (const Player& player : players_) order.push_back(&player);
  std::sort(order.begin(), order.end(), [](const Player* a, const Player* b) {
    return std::tie(b->held, a->gained, a->id) < std::tie(a->held, b->gained, b->id);
  });
  std::vector<TableRow> rows;
  for (const Player* player : order) rows.push_back({player->id, static_cast<std::int64_t>(player->held)});
  return rows;
}

std::uint64_t Hill::next_move() const {
  return round().phase == Phase::kPlay && mode_.places.size() > 1 ? next_move_ : 0;
}

void Hill::on_join(state::LouseId louse) {
  Player player;
  player.id = louse;
  players_.add(player);
}

void Hill::on_leave(state::LouseId louse) {
  players_.remove(louse);
  for (Player& player : players_) {
    if (player.bumped_by == louse) player.bumped_by = 0;
  }
}

void Hill::on_respawn(state::LouseId louse) {
  // A state from outside may have a louse of nobody's.
  if (Player* player = players_.find(louse)) player->bumped_by = 0;
}

void Hill::on_round(Step& step) {
  for (Player& player : players_) {
    player.held = player.gained = 0;
    player.bumped_by = 0;
  }
  holder_ = 0;
  is_contested_ = false;
  place_ = 0;
  next_move_ = step.tick + 1 + ticks_of(mode_.move_s);
  tell_move(step.tick + 1);
}

void Hill::judge(Step& step) {
  if (mode_.falls) take_fallen(step);
  if (crowd_) bump_all(step);
  bring_back(step);
  if (round().phase == Phase::kPlay) {
    move_place(step.tick + 1);
    return hold(step);
  }
  if (holder_ != 0 || is_contested_) note_change();
  holder_ = 0;
  is_contested_ = false;
}

void Hill::take_fallen(Step& step) {
  std::vector<std::pair<state::LouseId, double>> fallen;
  const std::span<const state::Louse> lice = step.world.lice();
  for (std::size_t k = 0; k < lice.size(); ++k) {
    if ((step.world.events()[k] & state::kLeft) != 0) fallen.emplace_back(lice[k].id, lice[k].distance);
  }
  for (const auto& [id, distance] : fallen) {
    Player* player = players_.find(id);
    if (player == nullptr) continue;
    step.world.erase(id);
    fall(*player, distance, step.tick + 1);
  }
}

void Hill::fall(Player& player, double distance, std::uint64_t now) {
  Player* by = player.bumped_by != 0 && now - player.bumped_at <= ticks_of(kBlame)
                   ? players_.find(player.bumped_by)
                   : nullptr;
  say({EventKind::kFell, player.id, now * kMomentsPerTick, {by != nullptr ? by->id : 0, 0, 0, 0}});
  player.out = now + ticks_of(mode_.out_s);
  player.distance = distance;
  player.bumped_by = 0;
  note_change();
  if (by != nullptr && round().phase == Phase::kPlay) gain(*by, ticks_of(kReward), now);
}

void Hill::bump_all(Step& step) {
  physics::World& world = step.world;
  const std::span<const state::Louse> lice = world.lice();
  bumpers_.clear();
  places_.clear();
  auto player = players_.begin();
  for (std::size_t k = 0; k < lice.size(); ++k) {
    if (lice[k].phase == state::Phase::kFlying) continue;
    while (player != players_.end() && player->id < lice[k].id) ++player;
    const bool is_played = player != players_.end() && player->id == lice[k].id;
    bumpers_.push_back(
        {static_cast<std::uint32_t>(k), is_played ? &*player : nullptr, {lice[k].velocity, {}}});
    places_.push_back(lice[k].position);
  }
  const state::Parameters& physics = world.parameters();
  const double push = 2.0 * world.step_seconds() * (physics.thrust_max + physics.gravity);
  bumps_.clear();
  for (const Crowd::Pair& pair : crowd_->pairs(places_)) meet(pair, push, step.tick + 1);
  for (std::size_t k = 0; k < bumpers_.size(); ++k) {
    const Bumper& bumper = bumpers_[k];
    if (bumper.is_bumped) world.set_motion_at(bumper.index, places_[k], bumper.body.velocity);
  }
  for (const Event& bump : bumps_) say(bump);
}

/// Of two who are near each other. push: what who presses comes on with at most [m/s].
inline void Hill::meet(const Crowd::Pair& pair, double push, std::uint64_t now) {
  Bumper& first = bumpers_[pair.first];
  Bumper& second = bumpers_[pair.second];
  if (!is_approach(pair.between, first.body.velocity, second.body.velocity)) return;
  for (const std::uint32_t k : {pair.first, pair.second}) {
    if (std::exchange(bumpers_[k].knows_ground, true)) continue;
    const terrain::SurfaceSample ground = ground_at(places_[k]);
    bumpers_[k].body.gradient = {ground.zx, ground.zy};
  }
  const double deep = kDeep * 2.0 * mode_.bump_radius;
  const bool presses = core::dot(pair.between, pair.between) < deep * deep &&
                       closing_speed(pair.between, first.body.velocity, second.body.velocity) <= push;
  const double restitution = presses ? std::max(mode_.bump_restitution, kThrownBack) : mode_.bump_restitution;
  const std::optional<Bump> bumped = bump(pair.between, first.body, second.body, restitution);
  if (!bumped) return;
  first.body.velocity = bumped->first;
  second.body.velocity = bumped->second;
  first.is_bumped = second.is_bumped = true;
  if (first.player != nullptr && second.player != nullptr)
    note_bump(*first.player, *second.player, bumped->impulse, now);
}

void Hill::note_bump(Player& first, Player& second, double impulse, std::uint64_t now) {
  first.bumped_by = second.id;
  second.bumped_by = first.id;
  first.bumped_at = second.bumped_at = now;
  note_change();
  if (impulse >= kToldImpulse)
    tell_bump({EventKind::kBump,
               first.id,
               now * kMomentsPerTick,
               {second.id, static_cast<std::int64_t>(1000.0 * impulse), 0, 0}});
}

/// If it is one of the hardest: in a crowd everybody meets somebody in every tick, and all hear of it.
void Hill::tell_bump(const Event& bump) {
  const auto is_softer = [&](const Event& other) { return other.values[1] < bump.values[1]; };
  if (bumps_.size() == kMostTold && !is_softer(bumps_.back())) return;
  if (bumps_.size() == kMostTold) bumps_.pop_back();
  bumps_.insert(std::find_if(bumps_.begin(), bumps_.end(), is_softer), bump);
}

void Hill::bring_back(Step& step) {
  const std::uint64_t now = step.tick + 1;
  for (Player& player : players_) {
    if (player.out == 0 || now < player.out) continue;
    const map::SpawnPoint& spawn = farthest_spawn(step.world);
    state::Louse louse;
    louse.id = player.id;
    louse.position = spawn.position;
    louse.heading = spawn.heading;
    louse.velocity = spawn.speed * spawn.heading;
    louse.distance = player.distance;
    // A state from outside may have it on the map as well.
    if (step.world.find(player.id) == nullptr) step.world.insert(louse);
    player.out = 0;
    player.distance = 0.0;
    say({EventKind::kReturned, player.id, now * kMomentsPerTick, {}});
    note_change();
  }
}

const map::SpawnPoint& Hill::farthest_spawn(const physics::World& world) const {
  const map::SpawnPoint* farthest = &spawns().front();
  double most = -1.0;
  for (const map::SpawnPoint& spawn : spawns()) {
    double nearest = 1e300;
    for (const state::Louse& louse : world.lice()) {
      const core::Vec2 way = images_.nearest(spawn.position, louse.position) - spawn.position;
      nearest = std::min(nearest, core::dot(way, way));
    }
    if (nearest <= most) continue;
    most = nearest;
    farthest = &spawn;
  }
  return *farthest;
}

void Hill::move_place(std::uint64_t now) {
  if (mode_.places.size() < 2) return;
  if (now >= next_move_) {
    place_ = (place_ + 1) % static_cast<std::uint32_t>(mode_.places.size());
    next_move_ = now + ticks_of(mode_.move_s);
    note_change();
  }
  tell_move(now);
}

void Hill::tell_move(std::uint64_t now) {
  if (mode_.places.size() < 2 || now + std::min(ticks_of(kWarning), ticks_of(mode_.move_s)) != next_move_)
    return;
  const std::size_t next = (place_ + 1) % mode_.places.size();
  say({EventKind::kMoving,
       0,
       now * kMomentsPerTick,
       {static_cast<std::int64_t>(next), static_cast<std::int64_t>(next_move_), 0, 0}});
}

void Hill::hold(Step& step) {
  const map::HillPlace& place = mode_.places[place_];
  const std::uint64_t now = step.tick + 1;
  Player* only = nullptr;
  std::size_t count = 0;
  for (const state::Louse& louse : step.world.lice()) {
    if (louse.phase == state::Phase::kFlying) continue;
    const core::Vec2 way = images_.nearest(place.at, louse.position) - place.at;
    if (!(core::dot(way, way) <= place.radius * place.radius)) continue;
    Player* player = players_.find(louse.id);
    if (player == nullptr || player->out != 0) continue;
    only = player;
    if (++count == 2) break;  // it is contested, by however many
  }
  const state::LouseId holder = count == 1 ? only->id : 0;
  const bool is_contested = count > 1;
  if (is_contested && !is_contested_) say({EventKind::kContested, 0, now * kMomentsPerTick, {}});
  if (!is_contested && (is_contested_ || holder != holder_))
    say({EventKind::kHolds, holder, now * kMomentsPerTick, {}});
  if (holder != holder_ || is_contested != is_contested_) note_change();
  holder_ = holder;
  is_contested_ = is_contested;
  if (count == 1) gain(*only, 1, now);
}

void Hill::gain(Player& player, std::uint64_t ticks, std::uint64_t now) {
  player.held = std::min(kMostHeld, player.held + ticks);
  player.gained = now;
  note_change();
  if (player.held >= winning()) end_round();
}

void Hill::write(StateWriter& out) const {
  out.put(static_cast<std::uint8_t>(place_));
  out.put(static_cast<std::uint8_t>(is_contested_));
  out.put(next_move_);
  out.put(holder_);
  out.put(static_cast<std::uint32_t>(players_.size()));
  for (const Player& player : players_) {
    out.put(player.id, player.bumped_by, player.held, player.gained, player.bumped_at, player.out,
            player.distance);
  }
}

bool Hill::read(StateReader& in, std::span<const state::LouseId> ids) {
  const auto is_known = [&](state::LouseId id) {
    return id == 0 || std::binary_search(ids.begin(), ids.end(), id);
  };
  place_ = in.get<std::uint8_t>();
  const auto contested = in.get<std::uint8_t>();
  next_move_ = in.get<std::uint64_t>();
  holder_ = in.get<std::uint32_t>();
  is_contested_ = contested != 0;
  if (place_ >= mode_.places.size() || contested > 1 || !is_known(holder_) || (is_contested_ && holder_ != 0))
    return false;
  players_.clear();
  const std::size_t count = in.get_count(4 + 4 + 4 * 8 + 8);
  for (std::size_t k = 0; k < count; ++k) {
    Player player;
    player.id = in.get<std::uint32_t>();
    player.bumped_by = in.get<std::uint32_t>();
    for (std::uint64_t* value : {&player.held, &player.gained, &player.bumped_at, &player.out})
      *value = in.get<std::uint64_t>();
    player.distance = in.get_bits();
    const bool has_gone = player.distance >= 0.0 && player.distance <= kMaxDistance;  // false for NaN
    if (k >= ids.size() || player.id != ids[k] || !is_known(player.bumped_by) ||
        player.bumped_by == player.id || player.held > kMostHeld || !has_gone ||
        (player.out == 0 && player.distance != 0.0))
      return false;
    players_.add(player);
  }
  return count == ids.size();
}

}  // namespace woodlouse::rules
