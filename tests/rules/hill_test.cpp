#include "shared/rules/hill.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"
#include "tests/rules/table.h"

using namespace woodlouse;
using namespace woodlouse::rules;
using tests::level_map;

namespace {

using Game = tests::Table<Hill>;

constexpr std::uint64_t kHz = 60;

/// One place of 3 m in the middle, lice that pass through each other, unless `fields` says otherwise.
std::string hill(const std::string& fields = "", const std::string& bump = R"("bump":{"radius":0})") {
  return R"("hill":{"places":[{"at":[0,0]},{"at":[10,0]},{"at":[-10,0],"radius":2}],)" + bump +
         (fields.empty() ? "" : "," + fields) + "}";
}

const std::string kBumps = R"("bump":{"radius":0.8,"restitution":0.8})";

std::int64_t held(Game& game, state::LouseId id) { return game.rules().standing(id).score; }

double energy(const physics::World& world) {
  double sum = 0.0;
  for (const state::Louse& louse : world.lice()) {
    const auto s = world.terrain().sample(louse.position.x, louse.position.y);
    const double rise = s.zx * louse.velocity.x + s.zy * louse.velocity.y;
    sum += 0.5 * (core::dot(louse.velocity, louse.velocity) + rise * rise);
  }
  return sum;
}

}  // namespace

TEST_CASE("who is alone on the place holds it, tick by tick, and nobody while several are on it") {
  Game game(level_map(hill()), state::Mode::kHill);
  game.join(1, {0, 0});
  game.join(2, {8, 8});
  game.step(60);
  CHECK(held(game, 1) == 0);
  CHECK(game.rules().holder() == 0);
  game.begin();
  game.step();
  CHECK(game.rules().holder() == 1);
  CHECK(held(game, 1) == 1);
  auto holds = game.said(EventKind::kHolds);
  REQUIRE(holds.size() == 1);
  CHECK(holds[0].louse == 1);
  game.step(99);
  CHECK(held(game, 1) == 100);
  game.put(2, {3.0, 0});  // on its edge
  game.step(10);
  CHECK(game.rules().is_contested());
  CHECK(game.rules().holder() == 0);
  CHECK(held(game, 1) == 100);
  CHECK(game.said(EventKind::kContested).size() == 1);
  CHECK(game.said(EventKind::kHolds).empty());
  game.put(1, {8, 8});
  game.step(5);
  CHECK(game.rules().holder() == 2);
  CHECK(held(game, 2) == 5);
  holds = game.said(EventKind::kHolds);
  REQUIRE(holds.size() == 1);
  CHECK(holds[0].louse == 2);
  game.put(2, {3.01, 0});
  game.step(5);
  CHECK(game.rules().holder() == 0);
  holds = game.said(EventKind::kHolds);
  REQUIRE(holds.size() == 1);
  CHECK(holds[0].louse == 0);
  CHECK(game.rules().table() == std::vector<TableRow>{{1, 100}, {2, 5}});
}

TEST_CASE("who flies holds nothing") {
  Game game(level_map(hill(), R"(,"contact":"unilateral")"), state::Mode::kHill);
  game.join(1, {0, 0});
  game.begin();
  state::Louse louse = *game.world().find(1);
  louse.phase = state::Phase::kFlying;
  louse.flight_z = 0.5;
  game.world().erase(1);
  game.world().insert(louse);
  game.step(10);
  CHECK(game.rules().holder() == (game.world().find(1)->phase == state::Phase::kFlying ? 0u : 1u));
}

TEST_CASE("the place moves on, is told of 5 s before, and comes round again") {
  Game game(level_map(hill(R"("move_s":20,"hold_s":1000)")), state::Mode::kHill);
  game.join(1, {10, 0});
  CHECK(game.rules().next_move() == 0);
  game.begin();
  const std::uint64_t begin = game.tick();
  for (std::uint64_t move = 1; move <= 7; ++move) {
    CHECK(game.rules().place() == (move - 1) % 3);
    CHECK(game.rules().next_move() == begin + move * 20 * kHz);
    while (game.tick() + 5 * kHz < begin + move * 20 * kHz) {
      CHECK(game.said(EventKind::kMoving).empty());
      game.step();
    }
    const auto moving = game.said(EventKind::kMoving);
    REQUIRE(moving.size() == 1);
    CHECK(moving[0].moment == game.tick() * 65536);
    CHECK(moving[0].values[0] == static_cast<std::int64_t>(move % 3));
    CHECK(moving[0].values[1] == static_cast<std::int64_t>(begin + move * 20 * kHz));
    game.step(5 * kHz);
  }
  CHECK(held(game, 1) == 2 * 20 * kHz + 1);
  // Sooner than it could be told: with the move before it.
  Game quick(level_map(hill(R"("move_s":3)")), state::Mode::kHill);
  quick.join(1, {8, 8});
  while (quick.rules().round().phase != Phase::kPlay) quick.step();
  CHECK(quick.said(EventKind::kMoving).size() == 1);
  quick.step(3 * kHz);
  CHECK(quick.rules().place() == 1);
  CHECK(quick.said(EventKind::kMoving).size() == 1);
  // Of one place there is no other.
  Game alone(level_map(R"("hill":{"places":[{"at":[0,0]}],"move_s":6})"), state::Mode::kHill);
  alone.join(1, {8, 8});
  alone.begin();
  alone.step(1000);
  CHECK(alone.rules().next_move() == 0);
  CHECK(alone.said(EventKind::kMoving).empty());
}

TEST_CASE("who has held it long enough first ends the round, and the next begins at nothing") {
  Game game(level_map(hill(R"("hold_s":2,"podium_s":3)")), state::Mode::kHill);
  game.join(1, {8, 8});
  game.join(2, {0, 0});
  game.begin();
  game.step(119);
  CHECK(game.rules().round().phase == Phase::kPlay);
  game.step();
  CHECK(game.rules().round().phase == Phase::kPodium);
  CHECK(game.rules().round().until == game.tick() + 180);
  CHECK(game.rules().table()[0] == TableRow{2, 120});
  game.step(180 + 180);
  CHECK(game.rules().holder() == 0);
  CHECK(game.rules().round().phase == Phase::kPlay);
  CHECK(game.rules().round().number == 2);
  CHECK(held(game, 2) == 0);
  game.step(1);
  CHECK(game.rules().holder() == 2);
}

TEST_CASE("a round that nobody wins ends after 15 minutes, or after three times what wins it") {
  for (const auto& [hold_s, longest] : {std::pair(60u, 900u), std::pair(301u, 903u)}) {
    tests::Table<Hill> game(level_map(hill("\"hold_s\":" + std::to_string(hold_s))), state::Mode::kHill, 10);
    game.join(1, {8, 8});
    game.begin();
    CHECK(game.rules().round().until == game.tick() + std::uint64_t{10} * longest);
    game.step(std::uint64_t{10} * longest - 1);
    CHECK(game.rules().round().phase == Phase::kPlay);
    game.step();
    CHECK(game.rules().round().phase == Phase::kPodium);
  }
}

TEST_CASE("who leaves by an open edge is out, and comes back where the others are far") {
  const std::string spawns =
      R"("spawns":[{"position":[5,5]},{"position":[-15,0]},{"position":[-15,0]},{"position":[10,10]}],)";
  Game game(level_map(spawns + hill(R"("edge":"fall","out_s":2,"hold_s":1000)")), state::Mode::kHill);
  game.join(1, {10, 0});
  game.join(2, {0, 0});
  game.step();
  game.put(2, {19.9, 0}, {12, 0});
  game.step();
  CHECK(game.world().find(2) == nullptr);
  CHECK(game.rules().is_out(2));
  CHECK_FALSE(game.rules().is_out(1));
  CHECK_FALSE(game.rules().is_out(9));
  auto fell = game.said(EventKind::kFell);
  REQUIRE(fell.size() == 1);
  CHECK(fell[0].louse == 2);
  CHECK(fell[0].values[0] == 0);
  game.step(119);
  CHECK(game.world().find(2) == nullptr);
  game.step();
  REQUIRE(game.world().find(2) != nullptr);
  CHECK_FALSE(game.rules().is_out(2));
  CHECK(game.world().find(2)->position == core::Vec2{-15, 0});
  CHECK(game.world().find(2)->velocity == core::Vec2{});
  CHECK(game.world().find(2)->distance == Approx(0.1));
  CHECK(game.said(EventKind::kReturned).size() == 1);
  // Two at once, with the first of these already there when the second comes.
  game.put(1, {-19.95, 1}, {-12, 0});
  game.put(2, {-19.95, 2}, {-12, 0});
  game.step();
  CHECK(game.world().lice().empty());
  game.step(120);
  CHECK(game.world().find(1)->position == core::Vec2{5, 5});
  CHECK(game.world().find(2)->position == core::Vec2{-15, 0});
}

TEST_CASE("walls stay walls where the mode does not let lice fall") {
  Game game(level_map(hill()), state::Mode::kHill);
  game.join(1, {19.9, 0}, {12, 0});
  game.step(5);
  CHECK(game.world().find(1)->velocity.x < 0);
  CHECK(game.said(EventKind::kFell).empty());
}

TEST_CASE("who bumped the fallen within 3 s has held 3 s more, in play, and may win by it") {
  const auto play = [](std::uint64_t wait, bool in_play, std::uint32_t hold_s) {
    Game game(level_map(hill(R"("edge":"fall","hold_s":)" + std::to_string(hold_s), kBumps)),
              state::Mode::kHill);
    game.join(1, {15, 10});
    game.join(2, {16, 10});
    if (in_play) {
      game.begin();
    } else {
      game.step(1);
    }
    game.put(1, {15, 10}, {3, 0});
    game.step();
    const auto bumps = game.said(EventKind::kBump);
    REQUIRE(bumps.size() == 1);
    CHECK(bumps[0].louse == 1);
    CHECK(bumps[0].values[0] == 2);
    CHECK(bumps[0].values[1] == 2700);
    CHECK(game.world().find(2)->velocity == core::Vec2{2.7, 0});
    game.put(2, {19, 0});
    game.step(wait - 2);
    game.put(2, {19.99, 0}, {12, 0});
    game.step(2);
    const auto fell = game.said(EventKind::kFell);
    REQUIRE(fell.size() == 1);
    if (fell[0].values[0] == 1) {
      CHECK(held(game, 1) == (in_play ? 180 : 0));
    } else {
      CHECK(fell[0].values[0] == 0);
      CHECK(held(game, 1) == 0);
    }
    return std::pair(fell[0].values[0] == 1, game.rules().round().phase);
  };
  CHECK(play(10, true, 1000) == std::pair(true, Phase::kPlay));
  CHECK(play(181, true, 1000) == std::pair(true, Phase::kPlay));
  CHECK(play(182, true, 1000) == std::pair(false, Phase::kPlay));
  CHECK(play(10, false, 1000) == std::pair(true, Phase::kCountdown));
  CHECK(play(10, true, 3) == std::pair(true, Phase::kPodium));
}

TEST_CASE("who has left gets nothing for whom it bumped") {
  Game game(level_map(hill(R"("edge":"fall")", kBumps)), state::Mode::kHill);
  game.join(1, {15, 0});
  game.join(2, {16, 0});
  game.begin();
  game.put(1, {15, 0}, {3, 0});
  game.step();
  REQUIRE(game.said(EventKind::kBump).size() == 1);
  game.rules().leave(1);
  game.world().erase(1);
  game.put(2, {19.99, 0}, {12, 0});
  game.step();
  const auto fell = game.said(EventKind::kFell);
  REQUIRE(fell.size() == 1);
  CHECK(fell[0].values[0] == 0);
}

TEST_CASE("lice that press against each other do not sink into each other, and gain no energy by it") {
  for (const double restitution : {0.0, 0.8, 1.0}) {
    for (const bool is_steep : {false, true}) {
      const std::string bump = R"("bump":{"radius":0.8,"restitution":)" + std::to_string(restitution) + "}";
      // In a valley's bottom, or on the level, with full thrust against each other.
      Game game(is_steep ? R"({"name":"m","terrain":{"function":"parabolic_pot"},)" + hill("", bump) + "}"
                         : level_map(hill("", bump)),
                state::Mode::kHill);
      game.join(1, {-0.9, 0});
      game.join(2, {0.9, 0});
      if (!is_steep) {
        game.world().set_thrust(1, {state::ThrustKind::kMapVector, {1, 0}}, state::kHeld);
        game.world().set_thrust(2, {state::ThrustKind::kMapVector, {-1, 0}}, state::kHeld);
      }
      double nearest = 9.0;
      for (int tick = 0; tick < 3600; ++tick) {
        game.rules().before_step(game.world());
        game.world().step();
        const double before = energy(game.world());
        game.rules().after_step(game.world(), static_cast<std::uint64_t>(tick), 1);
        REQUIRE(energy(game.world()) <= before * (1 + 1e-14));
        const core::Vec2 between = game.world().lice()[1].position - game.world().lice()[0].position;
        nearest = std::min(nearest, std::sqrt(core::dot(between, between)));
      }
      INFO("restitution " << restitution << (is_steep ? ", valley" : ", level"));
      CHECK(nearest > 0.85 * 1.6);
    }
  }
}

TEST_CASE(
    "many lice that bump never gain energy in it, on slopes and over seams, in whatever order they came") {
  for (const bool wraps : {false, true}) {
    const std::string text = R"({"name":"m","terrain":{"function":")" +
                             std::string(wraps ? "waves" : "hills") + "\"}" +
                             (wraps ? R"(,"edges":"wrap")" : "") +
                             R"(,"physics":{"contact":"unilateral","gravity":4},)" + hill("", kBumps) + "}";
    std::vector<state::Louse> ends[2];
    std::uint64_t hashes[2];
    std::size_t bumps = 0;
    for (const bool backwards : {false, true}) {
      Game game(text, state::Mode::kHill);
      for (state::LouseId k = 1; k <= 60; ++k) {
        const state::LouseId id = backwards ? 61 - k : k;
        core::Random random(id);
        const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
        const core::Vec2 place{symmetric(19), symmetric(19)};
        game.join(id, place, {symmetric(9), symmetric(9)});
        game.world().set_thrust(id, {state::ThrustKind::kMapVector, {-0.04 * place.x, -0.04 * place.y}},
                                state::kHeld);
      }
      for (std::uint64_t tick = 0; tick < 1200; ++tick) {
        game.rules().before_step(game.world());
        game.world().step();
        const double before = energy(game.world());
        game.rules().after_step(game.world(), tick, 1);
        REQUIRE(energy(game.world()) <= before * (1 + 1e-14));
        bumps += static_cast<std::size_t>(
            std::count_if(game.rules().events().begin(), game.rules().events().end(),
                          [](const Event& event) { return event.kind == EventKind::kBump; }));
      }
      ends[backwards].assign(game.world().lice().begin(), game.world().lice().end());
      hashes[backwards] = game.rules().hash();
    }
    CHECK(bumps > 200);
    CHECK(ends[0] == ends[1]);
    CHECK(hashes[0] == hashes[1]);
  }
}
