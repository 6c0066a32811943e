#include "shared/match/match.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "shared/map/map_world.h"

namespace woodlouse::match {

Match::Match(std::shared_ptr<const map::Map> map, const MatchSettings& settings)
    : map_(std::move(map)),
      settings_(settings),
      world_(map::make_world(*map_, 1.0 / static_cast<double>(settings.tick_hz))),
      random_(settings.seed),
      inputs_(kHorizonSeconds * settings.tick_hz) {
  assert(settings.tick_hz >= 1 && settings.tick_hz <= 1000);
  assert(!map_->definition.spawns.empty());
}

std::unique_ptr<Match> Match::restore(std::shared_ptr<const map::Map> map, const MatchSettings& settings,
                                      const MatchState& state) {
  assert(why_not(*map, settings, state).empty());
  auto match = std::make_unique<Match>(std::move(map), settings);
  match->world_.restore(state.lice);
  match->random_ = core::Random(state.generator);
  match->inputs_.restore(state.players, state.waiting);
  match->pending_roster_ = state.roster;
  match->next_player_ = state.next_player;
  match->tick_ = state.tick;
  match->hash_ = state.hash;
  if (state.tick != 0) match->link_ = {state.previous, state.inputs, state.tick, state.generator};
  return match;
}

MatchState Match::state() const {
  const auto lice = world_.lice();
  return {tick_,
          hash_,
          link_.previous,
          link_.inputs,
          random_.state(),
          next_player_,
          inputs_.players(),
          inputs_.waiting(),
          pending_roster_,
          {lice.begin(), lice.end()}};
}

bool Match::file_applied(const AppliedInput& input) {
  assert(input.tick == tick_);
  return inputs_.file_applied(input);
}

PlayerId Match::join() {
  const PlayerId player = next_player_;
  join_as(player);
  return player;
}

void Match::join_as(PlayerId player) {
  assert(player >= next_player_);
  next_player_ = player + 1;
  pending_roster_.push_back({RosterAction::kJoin, player});
  inputs_.add_player(player);
}

void Match::leave(PlayerId player) {
  pending_roster_.push_back({RosterAction::kLeave, player});
  inputs_.remove_player(player);
}

void Match::respawn(PlayerId player) { pending_roster_.push_back({RosterAction::kRespawn, player}); }

Filed Match::file(const Input& input) { return inputs_.file(input, tick_); }

void Match::spawn(PlayerId player, double distance) {
  const auto& spawns = map_->definition.spawns;
  const map::SpawnPoint& point = spawns[static_cast<std::size_t>(random_.next() % spawns.size())];
  state::Louse louse;
  louse.id = player;
  louse.position = point.position;
  louse.heading = point.heading;
  louse.velocity = point.speed * point.heading;
  louse.distance = distance;
  world_.insert(louse);
}

void Match::change_roster() {
  record_.roster.clear();
  for (const RosterChange& change : pending_roster_) {
    // A respawn or leave of a louse that is gone by now changes nothing and is not recorded.
    const state::Louse* louse = world_.find(change.player);
    if ((louse != nullptr) == (change.action == RosterAction::kJoin)) continue;
    const double distance = louse != nullptr ? louse->distance : 0.0;
    if (louse != nullptr) world_.erase(change.player);
    if (change.action != RosterAction::kLeave) spawn(change.player, distance);
    record_.roster.push_back(change);
  }
  pending_roster_.clear();
}

void Match::apply_inputs() {
  inputs_.take(tick_, record_.inputs);
  for (const AppliedInput& input : record_.inputs) {
    world_.set_thrust(input.player, {input.kind, input.thrust}, input.ticks);
  }
}

const StepRecord& Match::advance() {
  record_.tick = tick_;
  change_roster();
  apply_inputs();
  world_.step();
  ++tick_;

  hasher_.reset();
  hasher_.append(std::span<const AppliedInput>(record_.inputs));
  link_ = {hash_, hasher_.value(), tick_, random_.state()};
  hash_ = state::state_hash(hasher_, link_, world_.lice());
  record_.hash = hash_;
  return record_;
}

}  // namespace woodlouse::match
