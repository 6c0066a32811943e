#include "shared/match/match.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "shared/map/map_world.h"
#include "shared/map/spawns.h"

namespace woodlouse::match {

Match::Match(std::shared_ptr<const map::Map> map, const MatchSettings& settings)
    : map_(std::move(map)),
      settings_(settings),
      world_(map::make_world(*map_, 1.0 / static_cast<double>(settings.tick_hz), settings.mode)),
      rules_(rules::Rules::make(settings.mode, *map_, settings.tick_hz)),
      random_(settings.seed),
      inputs_(kHorizonSeconds * settings.tick_hz),
      link_(beginning(settings)) {
  assert(settings.tick_hz >= 1 && settings.tick_hz <= 1000);
  assert(!map_->definition.spawns.empty());
}

std::unique_ptr<Match> Match::restore(std::shared_ptr<const map::Map> map, const MatchSettings& settings,
                                      const MatchState& state) {
  assert(why_not(*map, settings, state).empty());
  auto match = std::make_unique<Match>(std::move(map), settings);
  match->world_.restore(state.lice);
  match->lice_hashes_.update(match->world_.lice(), match->world_.changed_blocks());
  match->world_.forget_changes();
  match->random_ = core::Random(state.link.generator);
  match->inputs_.restore(state.players, state.waiting);
  match->pending_roster_ = state.roster;
  match->labels_ = state.labels;
  match->next_player_ = state.next_player;
  if (match->rules_ != nullptr) {
    [[maybe_unused]] const bool fits = match->rules_->restore(state.rules, ids_on_roster(state));
    assert(fits);
  }
  match->tick_ = state.tick;
  match->hash_ = state.hash;
  match->link_ = state.link;
  return match;
}

MatchState Match::state() const {
  const auto lice = world_.lice();
  return {tick_,
          hash_,
          link_,
          next_player_,
          inputs_.players(),
          labels_,
          inputs_.waiting(),
          pending_roster_,
          {lice.begin(), lice.end()},
          rules_ != nullptr ? rules_->state() : std::string()};
}

bool Match::file_applied(const AppliedInput& input) {
  assert(input.tick == tick_);
  return inputs_.file_applied(input);
}

PlayerId Match::join(PlayerLabel label) {
  const PlayerId player = next_player_;
  join_as(player, std::move(label));
  return player;
}

void Match::join_as(PlayerId player, PlayerLabel label) {
  assert(player >= next_player_);
  assert(label.role != state::Role::kSpectator);
  next_player_ = player + 1;
  labels_[player] = label;
  pending_roster_.push_back({RosterAction::kJoin, player, std::move(label)});
  inputs_.add_player(player);
}

void Match::leave(PlayerId player) {
  pending_roster_.push_back({RosterAction::kLeave, player, {}});
  inputs_.remove_player(player);
  labels_.erase(player);
}

void Match::respawn(PlayerId player) { pending_roster_.push_back({RosterAction::kRespawn, player, {}}); }

void Match::respawn_at_gate(PlayerId player) {
  pending_roster_.push_back({RosterAction::kRespawnAtGate, player, {}});
}

Filed Match::file(const Input& input, std::size_t per_tick) { return inputs_.file(input, tick_, per_tick); }

void Match::spawn(PlayerId player, double distance) {
  const std::span<const map::SpawnPoint> spawns =
      rules_ != nullptr ? rules_->spawns() : std::span<const map::SpawnPoint>(map_->definition.spawns);
  const auto drawn = static_cast<std::size_t>(random_.next() % spawns.size());
  state::Louse louse = map::louse_at(spawns[drawn], player);
  louse.distance = distance;
  world_.insert(louse);
  record_.spawned.push_back({player, static_cast<std::uint32_t>(drawn)});
}

void Match::put_at_gate(PlayerId player, const rules::Start& at, double distance) {
  const double speed = std::sqrt(core::dot(at.velocity, at.velocity));
  state::Louse louse;
  louse.id = player;
  louse.position = at.position;
  louse.velocity = at.velocity;
  if (speed > 0.0) louse.heading = (1.0 / speed) * at.velocity;
  louse.distance = distance;
  world_.insert(louse);
}

/// REQUIRES that it changes something.
void Match::change(const RosterChange& change) {
  const state::Louse* louse = world_.find(change.player);
  const double distance = louse != nullptr ? louse->distance : 0.0;
  if (louse != nullptr) world_.erase(change.player);
  switch (change.action) {
    case RosterAction::kJoin:
      if (rules_ != nullptr) rules_->join(change.player);
      return spawn(change.player, distance);
    case RosterAction::kLeave:
      if (rules_ != nullptr) rules_->leave(change.player);
      return;
    case RosterAction::kRespawn:
      if (rules_ != nullptr) rules_->respawn(change.player);
      return spawn(change.player, distance);
    case RosterAction::kRespawnAtGate:
      if (rules_ == nullptr) return spawn(change.player, distance);
      if (const auto at = rules_->last_gate(change.player)) {
        rules_->respawn_at_gate(change.player);
        return put_at_gate(change.player, *at, distance);
      }
      rules_->respawn(change.player);
      return spawn(change.player, distance);
  }
  assert(false);
}

void Match::change_roster() {
  record_.roster.clear();
  record_.spawned.clear();
  for (const RosterChange& change : pending_roster_) {
    // A respawn or leave of a louse that is gone by now changes nothing and is not recorded, nor does a
    // respawn of one that is out.
    const bool has_louse = contains(change.player);
    const bool is_out = !has_louse && rules_ != nullptr && rules_->is_out(change.player);
    const bool changes = change.action == RosterAction::kJoin    ? !has_louse && !is_out
                         : change.action == RosterAction::kLeave ? has_louse || is_out
                                                                 : has_louse;
    if (!changes) continue;
    this->change(change);
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

void Match::judge() {
  if (rules_ == nullptr) return;
  rules_->after_step(world_, tick_, hash_);
  const std::span<const rules::Event> events = rules_->events();
  record_.events.assign(events.begin(), events.end());
}

/// A step that applied nothing and changed no byte makes no link: its hash is the one before.
void Match::link_up() {
  const bool lice_changed = lice_hashes_.update(world_.lice(), world_.changed_blocks(), team_.get());
  world_.forget_changes();
  const std::uint64_t rules = rules_ != nullptr ? rules_->hash() : 0;
  if (!lice_changed && record_.roster.empty() && record_.inputs.empty() && rules == link_.rules) {
    assert(random_.state() == link_.generator);
    return;
  }
  hasher_.reset();
  hasher_.append(std::span<const AppliedInput>(record_.inputs));
  const std::uint64_t inputs = hasher_.value();
  link_ = {hash_, inputs, roster_hash(hasher_, record_.roster), rules, tick_, random_.state()};
  hash_ = state::state_hash(hasher_, link_, lice_hashes_.values());
}

const StepRecord& Match::advance() {
  record_.tick = tick_;
  change_roster();
  apply_inputs();
  if (rules_ != nullptr) rules_->before_step(world_);
  world_.step();
  judge();
  ++tick_;
  link_up();
  record_.hash = hash_;
  return record_;
}

}  // namespace woodlouse::match
