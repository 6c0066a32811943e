// Forage and the hill in a match: what a re-run, a keyframe and strangers' bytes make of them.
#include "shared/match/match.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/match/match_state.h"
#include "shared/rules/forage.h"
#include "shared/rules/hill.h"
#include "tests/rules/table.h"

using namespace woodlouse;
using namespace woodlouse::match;

namespace {

struct Kind {
  const char* name;
  state::Mode mode;
  std::string map;
};

/// Small maps with short rounds, so that everything happens soon.
std::vector<Kind> kinds() {
  const std::string forage = R"("forage":{"crumbs":24,"radius":1.5,"round_s":8,"podium_s":2,"summits":6})";
  const std::string hill =
      R"("hill":{"places":[{"at":[0,0],"radius":4},{"at":[4,2],"radius":3}],"hold_s":6,"move_s":7,"out_s":1,"podium_s":2)";
  const std::string physics = R"("physics":{"thrust_max":9,"friction":0.1})";
  return {
      {"forage", state::Mode::kForage,
       R"({"name":"m","terrain":{"function":"wavy_pot","grid":6,"scale":10},)" + physics + "," + forage +
           "}"},
      {"forage over seams", state::Mode::kForage,
       R"({"name":"m","terrain":{"function":"waves","grid":6,"scale":10},"edges":"wrap",)" + physics + "," +
           forage + "}"},
      {"forage in the air", state::Mode::kForage,
       R"({"name":"m","terrain":{"function":"hills","grid":6,"scale":10},"physics":{"gravity":3,"contact":"unilateral","thrust_max":9},)" +
           forage + "}"},
      {"hill", state::Mode::kHill,
       R"({"name":"m","terrain":{"function":"hills","grid":6,"scale":10},)" + physics + "," + hill + "}}"},
      {"hill with edges to fall over", state::Mode::kHill,
       R"({"name":"m","terrain":{"function":"hills","grid":6,"scale":10},)" + physics + "," + hill +
           R"(,"edge":"fall"}})"},
      {"hill in the air", state::Mode::kHill,
       R"({"name":"m","terrain":{"function":"hills","grid":6,"scale":10},"physics":{"gravity":3,"contact":"unilateral","thrust_max":9},)" +
           hill + R"(,"edge":"fall"}})"}};
}

/// Joins, leaves, respawns and inputs; the same for every match that is given the same state of the same
/// generator.
struct Crowd {
  core::Random random{5};
  std::vector<PlayerId> players;
  std::vector<std::uint32_t> seqs;

  void stir(Match& match) {
    const std::uint64_t choice = random.next() % 60;
    if (choice < 2 || players.size() < 6) {
      players.push_back(match.join({"louse", state::Role::kBot}));
      seqs.push_back(0);
    } else if (choice == 2) {
      const std::size_t k = random.next() % players.size();
      match.leave(players[k]);
      players.erase(players.begin() + static_cast<std::ptrdiff_t>(k));
      seqs.erase(seqs.begin() + static_cast<std::ptrdiff_t>(k));
    } else if (choice == 3) {
      match.respawn(players[random.next() % players.size()]);
    }
    std::vector<Input> inputs;
    for (std::size_t k = 0; k < players.size(); ++k) {
      if (random.next() % 20 != 0) continue;
      const double angle = 6.3 * random.uniform();
      inputs.push_back({players[k],
                        ++seqs[k],
                        {state::ThrustKind::kMapVector, {std::cos(angle), std::sin(angle)}},
                        state::kHeld,
                        0});
      if (random.next() % 3 == 0) inputs.back().wanted_tick = match.tick() + random.next() % 100;
    }
    if (shuffles) std::reverse(inputs.begin(), inputs.end());
    for (const Input& input : inputs) match.file(input);
  }
  bool shuffles = false;
};

MatchSettings settings_of(const Kind& kind) { return {60, 77, kind.mode}; }

/// How much of what can happen did.
struct Seen {
  std::size_t events[16] = {};
  void note(const StepRecord& record) {
    for (const rules::Event& event : record.events) ++events[static_cast<std::size_t>(event.kind)];
  }
  [[nodiscard]] std::size_t of(rules::EventKind kind) const { return events[static_cast<std::size_t>(kind)]; }
};

}  // namespace

TEST_CASE("a match restored at any moment of a game goes on with the same hashes and the same events") {
  for (const Kind& kind : kinds()) {
    INFO(kind.name);
    const auto map = tests::map_of(kind.map);
    auto match = std::make_unique<Match>(map, settings_of(kind));
    Crowd crowd;
    Seen seen;
    std::unique_ptr<Match> other;
    Crowd beside;
    for (int tick = 0; tick < 3000; ++tick) {
      crowd.stir(*match);
      if (tick % 7 == 0) {
        beside = crowd;
        const MatchState state = match->state();
        REQUIRE(why_not(*map, settings_of(kind), state) == "");
        other = Match::restore(map, settings_of(kind), state);
      } else {
        beside.stir(*other);
      }
      const StepRecord& record = match->advance();
      const StepRecord& again = other->advance();
      seen.note(record);
      REQUIRE(again.hash == record.hash);
      REQUIRE(again.events == record.events);
      REQUIRE(other->link() == match->link());
      REQUIRE(std::equal(match->world().lice().begin(), match->world().lice().end(),
                         other->world().lice().begin(), other->world().lice().end()));
    }
    using rules::EventKind;
    if (kind.mode == state::Mode::kForage) {
      CHECK(seen.of(EventKind::kCrumb) > 100);
      CHECK(seen.of(EventKind::kHarvest) > 1);
      CHECK(seen.of(EventKind::kRound) > 6);
    } else {
      CHECK(seen.of(EventKind::kBump) > 50);
      CHECK(seen.of(EventKind::kRound) > 1);
      CHECK(seen.of(EventKind::kHolds) > 10);
      CHECK(seen.of(EventKind::kContested) > 3);
      CHECK(seen.of(EventKind::kMoving) > 1);
      CHECK((seen.of(EventKind::kFell) > 10) == map->definition.modes.hill->falls);
      CHECK((seen.of(EventKind::kReturned) > 5) == map->definition.modes.hill->falls);
    }
  }
}

TEST_CASE(
    "a game is the same bit for bit whatever the order in which inputs arrive and the lanes there are") {
  for (const Kind& kind : kinds()) {
    INFO(kind.name);
    const auto map = tests::map_of(kind.map);
    Match one(map, settings_of(kind)), other(map, settings_of(kind));
    other.use(physics::InstructionSet::kScalar);
    Crowd first, second;
    second.shuffles = true;
    for (int tick = 0; tick < 1500; ++tick) {
      first.stir(one);
      second.stir(other);
      REQUIRE(one.advance().hash == other.advance().hash);
    }
  }
}

TEST_CASE("bytes that are no state of the rules are refused, and those that are hurt nobody") {
  for (const Kind& kind : kinds()) {
    INFO(kind.name);
    const auto map = tests::map_of(kind.map);
    Match match(map, settings_of(kind));
    Crowd crowd;
    core::Random random(8);
    std::size_t refused = 0, taken = 0;
    for (int round = 0; round < 12; ++round) {
      for (int tick = 0; tick < 90 + 13 * round; ++tick) {
        crowd.stir(match);
        match.advance();
      }
      const MatchState state = match.state();
      const std::vector<state::LouseId> ids = ids_on_roster(state);
      const auto fresh = [&] { return rules::Rules::make(kind.mode, *map, 60); };
      REQUIRE(fresh()->restore(state.rules, ids));
      for (std::size_t size = 1; size < state.rules.size(); ++size)
        REQUIRE_FALSE(fresh()->restore(state.rules.substr(0, size), ids));
      REQUIRE_FALSE(fresh()->restore(state.rules + '\0', ids));
      REQUIRE_FALSE(fresh()->restore(state.rules, std::vector(ids.begin(), ids.end() - 1)));
      for (int flip = 0; flip < 150; ++flip) {
        MatchState damaged = state;
        for (std::uint64_t k = 1 + random.next() % 3; k > 0; --k) {
          const std::size_t at = random.next() % damaged.rules.size();
          damaged.rules[at] = random.next() % 2 == 0
                                  ? static_cast<char>(damaged.rules[at] ^ (1 << random.next() % 8))
                                  : static_cast<char>(random.next());
        }
        // With lice a hair outside the map, and out of it though they are on it: all that a state may have.
        for (state::Louse& louse : damaged.lice) {
          if (random.next() % 9 == 0) louse.position.x = map->terrain->domain().x_max + 1e-6;
        }
        if (random.next() % 4 == 0 && !damaged.lice.empty()) damaged.lice.pop_back();
        // A louse of nobody's, that respawns.
        if (random.next() % 4 == 0 && damaged.lice.size() > 1 && damaged.lice[0].id > 1) {
          damaged.lice.insert(damaged.lice.begin(), damaged.lice[0]);
          damaged.lice[0].id = 1;
          damaged.roster.push_back({RosterAction::kRespawn, 1, {}});
        }
        damaged.link.rules = core::stable_hash(damaged.rules);
        core::StableHasher hasher;
        damaged.hash = state::state_hash(hasher, damaged.link, damaged.lice);
        if (!why_not(*map, settings_of(kind), damaged).empty()) {
          ++refused;
          continue;
        }
        ++taken;
        const auto other = Match::restore(map, settings_of(kind), damaged);
        Crowd beside = crowd;
        for (int tick = 0; tick < 40; ++tick) {
          beside.stir(*other);
          other->advance();
        }
      }
    }
    CHECK(refused > 100);
    CHECK(taken > 100);
  }
}

TEST_CASE("who is out can leave, does not respawn, and what it filed is void") {
  const auto map = tests::map_of(
      tests::level_map(R"("spawns":[{"position":[19.9,0],"heading":[1,0],"speed":3},{"position":[-15,0]}],)"
                       R"("hill":{"places":[{"at":[0,0]}],"edge":"fall","out_s":1})"));
  Match match(map, {60, 3, state::Mode::kHill});
  std::vector<PlayerId> out;
  // Some begin where they soon fall.
  for (int k = 0; k < 12; ++k) match.join();
  for (int tick = 0; tick < 4; ++tick) match.advance();
  for (PlayerId id = 1; id <= 12; ++id) {
    if (match.rules()->is_out(id)) out.push_back(id);
    CHECK(match.contains(id) != match.rules()->is_out(id));
  }
  REQUIRE(out.size() >= 3);
  CHECK(match.labels().size() == 12);
  match.leave(out[0]);
  match.respawn(out[1]);
  match.file({out[2], 1, {state::ThrustKind::kMapVector, {1, 0}}, state::kHeld, 0});
  const StepRecord left = match.advance();
  REQUIRE(left.roster.size() == 1);
  CHECK(left.roster[0].player == out[0]);
  CHECK(left.inputs.size() == 1);
  CHECK_FALSE(match.rules()->is_out(out[0]));
  CHECK(match.rules()->is_out(out[1]));
  for (int tick = 0; tick < 60; ++tick) match.advance();
  CHECK_FALSE(match.contains(out[0]));
  for (std::size_t k = 1; k < out.size(); ++k) {
    CHECK(match.contains(out[k]));
    CHECK(match.world().find(out[k])->thrust_kind == state::ThrustKind::kNone);
  }
  for (PlayerId id = 1; id <= 12; ++id) {
    if (id != out[0]) match.leave(id);
  }
  match.advance();
  CHECK(match.rules()->stands_still());
  CHECK(match.stands_still());
}
