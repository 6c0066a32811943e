#include "server/bots/team.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "server/bots/forager.h"
#include "server/bots/king.h"
#include "server/bots/racer.h"

namespace woodlouse::server::bots {
namespace {

constexpr std::array<const char*, 4> kRacers = {"Dash", "Bolt", "Comet", "Zippy"};
constexpr std::array<const char*, 4> kForagers = {"Nibble", "Crumbly", "Pantry", "Magpie"};
constexpr std::array<const char*, 4> kKings = {"Rex", "Regina", "Baron", "Duchess"};

const std::array<const char*, 4>& names(state::Mode mode) {
  return mode == state::Mode::kRace ? kRacers : mode == state::Mode::kForage ? kForagers : kKings;
}

}  // namespace

std::string player_name(state::Mode mode, std::uint32_t number) {
  const auto& all = names(mode);
  std::string name = all[number % all.size()];
  if (number >= all.size()) name += ' ' + std::to_string(number / all.size() + 1);
  return name;
}

Team::Team(const map::Map& map, const match::MatchSettings& settings, Skill skill, std::uint32_t bots)
    : map_(map), settings_(settings), skill_(skill), foresight_(map, in_crowd(ability(skill), bots)) {
  assert(settings.mode != state::Mode::kRoam && map.definition.modes.has(settings.mode));
  if (settings.mode == state::Mode::kRace)
    route_ = std::make_unique<Route>(*map.definition.modes.race, foresight_.effort());
}

std::unique_ptr<Player> Team::make(std::uint32_t number) const {
  // A stream of its own: those of neighbouring seeds of one generator would be one draw apart.
  const std::uint64_t seed = core::Random(settings_.seed ^ (0xD1B54A32D192ED03u * (number + 1))).next();
  const map::Modes& modes = map_.definition.modes;
  if (settings_.mode == state::Mode::kRace) return std::make_unique<Racer>(*route_, skill_, seed);
  if (settings_.mode == state::Mode::kForage)
    return std::make_unique<Forager>(modes.forage->radius, skill_, seed);
  return std::make_unique<King>(skill_, seed);
}

void Team::take(match::PlayerId louse, std::uint32_t number, std::uint32_t& next_seq) {
  Member member{louse, &next_seq, make(number), 1, 0, 0};
  const Ability& ability = member.player->ability();
  member.every = std::max(1u, settings_.tick_hz / ability.decisions);
  member.turn = louse % member.every;
  member.delay = static_cast<std::uint64_t>(std::ceil(ability.reaction_s * settings_.tick_hz));
  members_.push_back(std::move(member));
}

std::span<const match::PlayerId> Team::steer(match::Match& game) {
  respawned_.clear();
  sight_.look(game);
  for (Member& member : members_) {
    if (game.tick() % member.every == member.turn) steer(game, member);
  }
  return respawned_;
}

void Team::steer(match::Match& game, Member& member) {
  const GameView* seen = sight_.before(game.tick(), member.delay);
  if (seen == nullptr || seen->tick < member.blind_until) return;
  const std::size_t own = seen->find(member.louse);
  if (own == seen->lice.size() || !game.contains(member.louse)) return;
  const Scene scene{*seen, own, game.tick(), 1.0 / settings_.tick_hz};
  const Order order = member.player->decide(scene, foresight_);
  if (order.respawns) {
    game.respawn(member.louse);
    respawned_.push_back(member.louse);
    member.blind_until = game.tick() + 1;
    return;
  }
  game.file({member.louse, (*member.next_seq)++, order.thrust, state::kHeld, 0});
}

}  // namespace woodlouse::server::bots
