#include "server/room/house_bots.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "shared/map/map_file.h"
#include "shared/match/match.h"
#include "shared/physics/central_gravity.h"
#include "shared/protocol/messages.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

std::shared_ptr<const map::Map> load(const std::string& name) {
  auto map = map::load_map(std::string(WOODLOUSE_SOURCE_DIR "/maps/") + name + ".json");
  REQUIRE(map);
  return *map;
}

/// What one bot did in a game of its own: a louse a tick, and the thrusts it chose.
struct Game {
  std::vector<state::Louse> lice;
  std::vector<state::Thrust> thrusts;
};

Game play(const std::shared_ptr<const map::Map>& map, std::uint32_t number, std::uint64_t seed, int seconds) {
  match::Match match(map, {60, seed});
  HouseBot bot(number, seed);
  const match::PlayerId player = match.join();
  match.advance();
  Game game;
  std::uint32_t seq = 0;
  for (int tick = 0; tick < 60 * seconds; ++tick) {
    if (tick % 6 == 0) {
      const auto& world = match.world();
      game.thrusts.push_back(bot.decide({*world.find(player), world.terrain(), world.parameters()}));
      match.file({player, ++seq, game.thrusts.back(), state::kHeld, 0});
    }
    match.advance();
    game.lice.push_back(*match.world().find(player));
  }
  return game;
}

double height(const map::Map& map, const state::Louse& louse) {
  return map.terrain->sample(louse.position.x, louse.position.y).z;
}

}  // namespace

TEST_CASE("every bot on every map pushes within the wire's range and steps, and keeps moving") {
  const auto map = load(GENERATE("parabolic_pot", "wavy_pot", "volcano", "hills", "maunga_whau"));
  const auto number = GENERATE(range(0u, 4u));
  const Game game = play(map, number, 12, 60);
  CAPTURE(number, map->definition.name);
  for (const state::Thrust& thrust : game.thrusts) {
    REQUIRE(thrust.kind == state::ThrustKind::kMapVector);
    REQUIRE(core::dot(thrust.value, thrust.value) <= 1.0);
    REQUIRE(thrust.value.x * 128.0 == std::nearbyint(thrust.value.x * 128.0));
    REQUIRE(thrust.value.y * 128.0 == std::nearbyint(thrust.value.y * 128.0));
  }
  CHECK(game.lice.back().distance > 10.0);
  // Nor does it ever give up.
  for (std::size_t second = 10; second + 10 <= 60; ++second)
    REQUIRE(game.lice[60 * (second + 10) - 1].distance > game.lice[60 * second].distance + 0.5);
}

TEST_CASE("the same seed gives the same game, another seed another") {
  const auto map = load("volcano");
  const auto number = GENERATE(range(0u, 4u));
  const Game a = play(map, number, 5, 30);
  const Game b = play(map, number, 5, 30);
  CHECK(a.thrusts == b.thrusts);
  CHECK(a.thrusts != play(map, number, 6, 30).thrusts);
}

TEST_CASE("the climber climbs out of a pot, the roller spends its time lower than the climber") {
  const auto map = load("parabolic_pot");
  const Game climber = play(map, 1, 3, 60);
  const Game roller = play(map, 0, 3, 60);
  double top = -1e9, climber_mean = 0.0, roller_mean = 0.0;
  for (std::size_t i = 0; i < climber.lice.size(); ++i) {
    top = std::max(top, height(*map, climber.lice[i]));
    climber_mean += height(*map, climber.lice[i]);
    roller_mean += height(*map, roller.lice[i]);
  }
  CHECK(top > height(*map, climber.lice.front()) + 1.0);
  CHECK(climber_mean > roller_mean);
}

TEST_CASE("the orbiter goes round the middle at a steady distance") {
  const auto map = load("parabolic_pot");
  const Game game = play(map, 2, 8, 120);
  double turned = 0.0, nearest = 1e9, farthest = 0.0;
  for (std::size_t i = game.lice.size() / 3; i + 1 < game.lice.size(); ++i) {
    const core::Vec2 a = game.lice[i].position;
    const core::Vec2 b = game.lice[i + 1].position;
    turned += std::atan2(a.x * b.y - a.y * b.x, core::dot(a, b));
    nearest = std::min(nearest, std::hypot(a.x, a.y));
    farthest = std::max(farthest, std::hypot(a.x, a.y));
  }
  CHECK(std::abs(turned) > 2.0 * 3.14159);
  CHECK(farthest < 1.3 * nearest);
}

TEST_CASE("bots have names of their own, within the wire's length") {
  std::set<std::string> names;
  for (std::uint32_t number = 0; number < 100; ++number) {
    const HouseBot bot(number, 1);
    CHECK(names.insert(bot.name()).second);
    CHECK(bot.name().size() <= protocol::kMaxNameBytes);
  }
}

TEST_CASE("on the planet eight bots' energies rise in ten minutes by the work of their thrusts alone") {
  const auto map = load("kepler");
  const state::Parameters& p = map->definition.physics;
  const auto energy_of = [&](const state::Louse& louse) {
    return 0.5 * core::dot(louse.velocity, louse.velocity) + physics::central_potential(louse.position, p);
  };
  // Level ground: a held map vector's work is its product with the way; walls only take.
  struct Account {
    double last, unpaid, least;  ///< energy; what no work explains, and the least of it so far
  };
  const std::uint64_t seed = GENERATE(1u, 2u, 3u);
  match::Match match(map, {60, seed});
  std::map<match::PlayerId, HouseBot> bots;
  std::map<match::PlayerId, Account> accounts;
  std::map<match::PlayerId, std::uint32_t> seqs;
  for (std::uint32_t number = 0; number < 8; ++number) bots.emplace(match.join(), HouseBot(number, seed));
  match.advance();
  for (const state::Louse& louse : match.world().lice()) accounts[louse.id] = {energy_of(louse), 0.0, 0.0};
  double worst = 0.0, highest = -1e300, lowest = 1e300;
  for (int tick = 0; tick < 60 * 600; ++tick) {
    for (auto& [player, bot] : bots) {
      const auto& world = match.world();
      if ((match.tick() + player) % 6 != 0) continue;
      match.file(
          {player, ++seqs[player], bot.decide({*world.find(player), world.terrain(), p}), state::kHeld, 0});
    }
    const std::vector<state::Louse> before(match.world().lice().begin(), match.world().lice().end());
    match.advance();
    for (const state::Louse& from : before) {
      const state::Louse& louse = *match.world().find(from.id);
      Account& account = accounts[louse.id];
      const double now = energy_of(louse);
      const double work = p.thrust_max * core::dot(louse.thrust, louse.position - from.position);
      account.unpaid += now - account.last - work;
      account.last = now;
      account.least = std::fmin(account.least, account.unpaid);
      worst = std::fmax(
          worst, (account.unpaid - account.least) / (now - physics::central_potential(core::Vec2{}, p)));
      highest = std::fmax(highest, now);
      lowest = std::fmin(lowest, now);
    }
  }
  INFO("seed " << seed << ": of the energy above the core's bottom " << worst << "; energies " << lowest
               << " to " << highest);
  REQUIRE(accounts.size() == 8);
  CHECK(highest - lowest > 1.0);  // they do play
  CHECK(worst < 1e-4);            // of the 1e-3 that the method may err
}
