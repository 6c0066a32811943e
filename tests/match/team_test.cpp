// Whoever steps the lice, the bits are the same: at every tick, on every kind of map, by teams of any size,
// by one that does its parts the wrong way round, and where the team is at another room's work.
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/core/thread_team.h"
#include "shared/match/match.h"
#include "tests/support/big_map_files.h"
#include "tests/support/maps_of_all_kinds.h"

namespace woodlouse::match {
namespace {

/// The last part first, and counts how often it was asked.
class ReversedTeam final : public core::Team {
 public:
  explicit ReversedTeam(core::Cut cut = core::Cut::kFinest) : Team(3, cut) {}
  bool try_run(std::size_t parts, const Work& work) override {
    ++jobs;
    while (parts-- > 0) work(parts);
    return true;
  }
  std::size_t jobs = 0;
};

/// Always at another's work.
class TakenTeam final : public core::Team {
 public:
  TakenTeam() : Team(2, core::Cut::kFinest) {}
  bool try_run(std::size_t, const Work&) override {
    ++refused;
    return false;
  }
  std::size_t refused = 0;
};

/// A game in which much happens; the same one whoever steps it.
class Game {
 public:
  Game(std::shared_ptr<const map::Map> map, physics::InstructionSet set, std::shared_ptr<core::Team> team,
       std::size_t lice)
      : map_(std::move(map)), set_(set), team_(std::move(team)) {
    begin(std::make_unique<Match>(map_, kSettings));
    for (std::size_t k = 0; k < lice; ++k) come();
  }

  void step(bool restored) {
    if (restored) begin(Match::restore(map_, kSettings, match_->state()));
    const std::uint64_t choice = random_.next() % 12;
    if (choice == 0) come();
    if (choice == 1) go(random_.next() % players_.size());
    if (choice == 2) {  // as many as before, and all behind him in other places
      go(0);
      come();
    }
    if (choice == 3) match_->respawn(players_[random_.next() % players_.size()]);
    for (int k = 0; k < 6; ++k) push(players_[random_.next() % players_.size()]);
    match_->advance();
  }

  [[nodiscard]] const Match& match() const { return *match_; }

 private:
  static constexpr MatchSettings kSettings{60, 7};

  void begin(std::unique_ptr<Match> match) {
    match_ = std::move(match);
    match_->use(set_);
    match_->use(team_);
  }
  void come() { players_.push_back(match_->join({"a", state::Role::kBot})); }
  void go(std::size_t place) {
    match_->leave(players_[place]);
    players_.erase(players_.begin() + static_cast<std::ptrdiff_t>(place));
  }
  void push(PlayerId player) {
    constexpr std::uint32_t kTicks[] = {0, 1, 3, 9, state::kHeld};
    const auto share = [&] { return (static_cast<double>(random_.next() % 129) - 64.0) / 128.0; };
    state::Thrust thrust{state::ThrustKind::kMapVector, {share(), share()}};
    const std::uint64_t kind = random_.next() % 4;
    if (kind == 0) thrust = {};
    if (kind == 1) thrust = {state::ThrustKind::kAlongHeading, {share(), 0.0}};
    if (kind == 2) thrust = {state::ThrustKind::kAlongHeading, {1.0 / 128.0, 0.0}};  // moves hardly anybody
    match_->file({player, ++seq_, thrust, kTicks[random_.next() % 5], 0});
  }

  std::shared_ptr<const map::Map> map_;
  physics::InstructionSet set_;
  std::shared_ptr<core::Team> team_;
  std::unique_ptr<Match> match_;
  std::vector<PlayerId> players_;
  core::Random random_{3};
  std::uint32_t seq_ = 0;
};

void check_same(const map::Map& map, const Game& game, const Game& alone, const char* who) {
  INFO(map.definition.name << ", tick " << alone.match().tick() << ", " << who << ", "
                           << alone.match().world().lice().size() << " lice");
  REQUIRE(game.match().hash() == alone.match().hash());
  const physics::StepCounters a = game.match().world().counters(), b = alone.match().world().counters();
  REQUIRE(a.louse_steps == b.louse_steps);
  REQUIRE(a.sub_steps == b.sub_steps);
}

}  // namespace

TEST_CASE("1, 2, 3 and 5 threads give the same hash at every tick on every kind of map") {
  const tests::BigMapFiles big("team");
  const std::vector<std::shared_ptr<core::Team>> teams{
      std::make_shared<core::ThreadTeam>(1, core::Cut::kFinest),
      std::make_shared<core::ThreadTeam>(2, core::Cut::kFinest),
      std::make_shared<core::ThreadTeam>(3, core::Cut::kFinest),
      std::make_shared<core::ThreadTeam>(5, core::Cut::kFinest),
      std::make_shared<ReversedTeam>(),
      std::make_shared<TakenTeam>()};
  const char* const names[] = {"1 thread", "2 threads", "3 threads", "5 threads", "reversed", "taken"};
  std::vector<physics::InstructionSet> sets;
  for (const auto set :
       {physics::InstructionSet::kScalar, physics::InstructionSet::kAvx2, physics::InstructionSet::kAvx512}) {
    if (physics::is_available(set)) sets.push_back(set);
  }
  std::size_t round = 0;
  for (const auto& map : tests::maps_of_all_kinds(big)) {
    for (const std::size_t border : {64u, 128u, 192u}) {
      for (const std::size_t lice : {border - 1, border, border + 1}) {
        // Each set in turns: the batch test has them against each other.
        const physics::InstructionSet set = sets[round++ % sets.size()];
        Game alone(map, set, nullptr, lice);
        std::vector<Game> games;
        for (const auto& team : teams) games.emplace_back(map, set, team, lice);
        for (int tick = 0; tick < 20; ++tick) {
          alone.step(false);
          for (std::size_t k = 0; k < games.size(); ++k) {
            games[k].step(tick == 11);
            if (tick < 11) check_same(*map, games[k], alone, names[k]);
            REQUIRE(games[k].match().hash() == alone.match().hash());
          }
        }
      }
    }
  }
  // The parts were really made.
  CHECK(static_cast<ReversedTeam&>(*teams[4]).jobs > 3000);
  CHECK(static_cast<TakenTeam&>(*teams[5]).refused > 3000);
}

TEST_CASE("a copy of a world shares its team, and few lice are not worth one") {
  const tests::BigMapFiles big("team_copy");
  const auto map = tests::maps_of_all_kinds(big).front();
  for (const std::size_t lice : {2 * physics::World::kMemberLice - 1, 2 * physics::World::kMemberLice}) {
    const auto team = std::make_shared<ReversedTeam>(core::Cut::kWorthIt);
    physics::World world(map->terrain, map->definition.physics, 1.0 / 60);
    world.use(std::shared_ptr<core::Team>(team));
    core::Random random(4);
    for (std::size_t k = 0; k < lice; ++k) {
      state::Louse louse;
      louse.id = static_cast<state::LouseId>(k + 1);
      louse.position = {random.uniform(), random.uniform()};
      louse.velocity = {1.0 + random.uniform(), 0.0};
      world.insert(louse);
    }
    physics::World copy = world;
    physics::World alone = world;
    alone.use(std::shared_ptr<core::Team>());
    for (physics::World* each : {&world, &copy, &alone}) each->step();
    const bool is_worth_it = lice == 2 * physics::World::kMemberLice;
    CHECK(team->jobs == (is_worth_it ? 2 : 0));
    core::StableHasher hasher;
    CHECK(state::state_hash(hasher, {}, world.lice()) == state::state_hash(hasher, {}, alone.lice()));
    CHECK(state::state_hash(hasher, {}, copy.lice()) == state::state_hash(hasher, {}, alone.lice()));
  }
}

}  // namespace woodlouse::match
