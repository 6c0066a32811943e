#include "shared/match/match_state.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <string_view>
#include <tuple>
#include <variant>

#include "shared/core/joined.h"
#include "shared/match/match.h"
#include "shared/state/louse_fields.h"

namespace woodlouse::match {
namespace {

using core::joined;

constexpr double kMaxSpeed = 1e6;      // [m/s]
constexpr double kMaxHeight = 1e9;     // [m]
constexpr double kMaxDistance = 1e15;  // [m]
constexpr double kUnitSlack = 1e-9;    // of a squared length of 1

bool is_within(double value, double limit) { return value >= -limit && value <= limit; }

bool is_within(core::Vec2 value, double limit) {
  return is_within(value.x, limit) && is_within(value.y, limit);
}

/// Steps leave nobody outside, but for the last bit.
bool is_on(const terrain::Rectangle& domain, core::Vec2 at) {
  const double slack_x = 1e-6 * (domain.x_max - domain.x_min);
  const double slack_y = 1e-6 * (domain.y_max - domain.y_min);
  return at.x >= domain.x_min - slack_x && at.x <= domain.x_max + slack_x && at.y >= domain.y_min - slack_y &&
         at.y <= domain.y_max + slack_y;
}

/// Over the map plane or up and down.
bool is_too_fast(const state::Louse& louse) {
  return std::any_of(state::kLouseFields.begin(), state::kLouseFields.end(),
                     [&](const state::LouseField& field) {
                       return field.unit == "m/s" && !is_within(state::field_value(louse, field), kMaxSpeed);
                     });
}

std::string_view fault_of(const map::Map& map, const state::Louse& louse) {
  if (!is_on(map.terrain->domain(), louse.position)) return "is not on the map";
  if (is_too_fast(louse)) return "is too fast";
  if (!is_within(louse.flight_z, kMaxHeight)) return "flies too high";
  const double heading2 = core::dot(louse.heading, louse.heading);
  if (!(heading2 > 1.0 - kUnitSlack && heading2 < 1.0 + kUnitSlack)) return "has no heading of length 1";
  if (!is_within(louse.thrust, 1.0)) return "has a thrust above 1";
  if (!is_within(louse.distance, kMaxDistance)) return "has gone too far";
  if (louse.phase > state::Phase::kFlying || louse.thrust_kind > state::ThrustKind::kMapVector) {
    return "has a phase or kind of thrust that is none";
  }
  // Over a plane nothing takes off.
  const bool may_fly = map.definition.physics.contact == state::SurfaceContact::kUnilateral &&
                       !std::holds_alternative<terrain::PlaneSurface>(map.terrain->surface());
  if (louse.phase == state::Phase::kFlying && !may_fly) return "flies where nobody can";
  return {};
}

std::string fault_of_lice(const map::Map& map, const MatchState& state) {
  state::LouseId before = 0;
  for (const state::Louse& louse : state.lice) {
    const std::string name = joined({"louse ", std::to_string(louse.id)});
    if (louse.id <= before || louse.id >= state.next_player) return joined({name, " is out of order"});
    before = louse.id;
    const std::string_view fault = fault_of(map, louse);
    if (!fault.empty()) return joined({name, " ", fault});
  }
  return {};
}

std::string fault_of_players(const MatchState& state) {
  const bool are_all_named =
      std::equal(state.players.begin(), state.players.end(), state.labels.begin(), state.labels.end(),
                 [](const PlayerSeq& player, const auto& label) {
                   return player.player == label.first && label.second.role != state::Role::kSpectator;
                 });
  if (!are_all_named) return "each of its players has one name and is a player or a bot, and nobody else is";
  state::LouseId before = 0;
  for (const PlayerSeq& entry : state.players) {
    if (entry.player <= before || entry.player >= state.next_player) {
      return joined({"player ", std::to_string(entry.player), " is out of order"});
    }
    before = entry.player;
  }
  for (const RosterChange& change : state.roster) {
    if (change.player == 0 || change.player >= state.next_player) {
      return joined({"a change of player ", std::to_string(change.player), ", who never was"});
    }
  }
  return {};
}

std::string fault_of_waiting(const MatchState& state, std::uint64_t horizon) {
  const AppliedInput* before = nullptr;
  for (const AppliedInput& input : state.waiting) {
    const std::string name = joined(
        {"the waiting input of player ", std::to_string(input.player), " seq ", std::to_string(input.seq)});
    const auto key = [](const AppliedInput& i) { return std::tuple(i.tick, i.player, i.seq); };
    if (before != nullptr && key(*before) >= key(input)) return joined({name, " is out of order"});
    before = &input;
    if (input.tick < state.tick || input.tick - state.tick > horizon) {
      return joined({name, " is for tick ", std::to_string(input.tick)});
    }
    const auto owner = std::lower_bound(state.players.begin(), state.players.end(), input.player,
                                        [](const PlayerSeq& p, state::LouseId id) { return p.player < id; });
    if (owner == state.players.end() || owner->player != input.player)
      return joined({name, " has no player"});
    if (owner->last_seq < input.seq) return joined({name, " has a seq above the player's last"});
  }
  return {};
}

std::string fault_of_rules(const map::Map& map, const MatchSettings& settings, const MatchState& state) {
  if (state.rules.empty() != (state.link.rules == 0))
    return "its rules' state and their hash don't go together";
  if (state.rules.empty()) return {};
  if (core::stable_hash(state.rules) != state.link.rules) return "its rules' state has another hash";
  const auto rules = rules::Rules::make(settings.mode, map, settings.tick_hz);
  if (rules == nullptr) return "it has a state of rules, and its mode has none";
  return rules->restore(state.rules, ids_on_roster(state)) ? std::string()
                                                           : "its rules' state is none of this map and mode";
}

}  // namespace

state::HashLink beginning(const MatchSettings& settings) { return {0, 0, 0, 0, 0, settings.seed}; }

std::vector<state::LouseId> ids_on_roster(const MatchState& state) {
  std::set<state::LouseId> ids;
  for (const PlayerSeq& player : state.players) ids.insert(player.player);
  // What is queued has changed who may file inputs, and nothing else yet.
  for (auto change = state.roster.rbegin(); change != state.roster.rend(); ++change) {
    if (change->action == RosterAction::kLeave) ids.insert(change->player);
    if (change->action == RosterAction::kJoin) ids.erase(change->player);
  }
  return {ids.begin(), ids.end()};
}

std::uint64_t roster_hash(core::StableHasher& hasher, std::span<const RosterChange> changes) {
  hasher.reset();
  for (const RosterChange& change : changes) {
    assert(change.label.name.size() <= UINT32_MAX);
    for (const std::uint32_t word : {static_cast<std::uint32_t>(change.action), change.player,
                                     static_cast<std::uint32_t>(change.label.role),
                                     static_cast<std::uint32_t>(change.label.name.size())})
      hasher.append(word);
    hasher.append(change.label.name.data(), change.label.name.size());
  }
  return hasher.value();
}

std::string why_not(const map::Map& map, const MatchSettings& settings, const MatchState& state) {
  std::string fault = fault_of_players(state);
  if (fault.empty()) fault = fault_of_lice(map, state);
  if (fault.empty()) fault = fault_of_waiting(state, kHorizonSeconds * settings.tick_hz);
  if (!fault.empty()) return fault;
  if (state.link.tick > state.tick)
    return joined({"its hash is of tick ", std::to_string(state.link.tick), ", which is later"});
  if (state.link.tick == 0) {
    const bool is_beginning =
        state.hash == 0 && state.link == beginning(settings) && state.lice.empty() && state.rules.empty();
    return is_beginning ? std::string()
                        : "before the first step that did something there are no lice and no hash, and the "
                          "generator is the seed";
  }
  fault = fault_of_rules(map, settings, state);
  if (!fault.empty()) return fault;
  core::StableHasher hasher;
  const std::uint64_t hash = state::state_hash(hasher, state.link, state.lice);
  if (hash == state.hash) return {};
  return joined({"its hash is ", core::to_hex(hash), ", not ", core::to_hex(state.hash)});
}

}  // namespace woodlouse::match
