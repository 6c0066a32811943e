// Where crumbs lie.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "shared/core/random.h"
#include "shared/rules/forage.h"
#include "tests/rules/table.h"

using namespace woodlouse;
using namespace woodlouse::rules;
using tests::level_map;

namespace {

using Game = tests::Table<Forage>;

std::string forage(const std::string& fields) { return "\"forage\":{" + fields + "}"; }

}  // namespace

TEST_CASE("crumbs lie from the beginning of play on, within the map, apart, and away from lice") {
  for (const char* mode : {R"("crumbs":24)", R"("crumbs":64,"summits":9)", R"("crumbs":1,"summits":0)"}) {
    Game game(R"({"name":"m","terrain":{"function":"hills"},)" + forage(mode) + "}", state::Mode::kForage);
    CHECK(game.rules().stands_still());
    CHECK(game.rules().hash() == 0);
    game.join(1, {0, 0});
    game.join(2, {5, 5});
    game.step();
    CHECK(game.rules().round().phase == Phase::kCountdown);
    CHECK(game.rules().crumbs().empty());
    game.begin();
    CHECK(game.tick() == 181);  // 3 s after the first step
    const auto crumbs = game.rules().crumbs();
    const std::size_t slots = game.map().definition.modes.forage->crumbs;
    REQUIRE(crumbs.size() == slots);
    CHECK(game.rules().changed() == (slots == 64 ? ~0ull : (1ull << slots) - 1));
    std::size_t good = 0;
    for (const ShownCrumb& crumb : crumbs) {
      CHECK((std::abs(crumb.position.x) <= 19 && std::abs(crumb.position.y) <= 19));
      CHECK((crumb.value == 1 || crumb.value == 3));
      CHECK(crumb.position.x * 1024 == std::floor(crumb.position.x * 1024));
      bool is_apart = true;
      for (const ShownCrumb& other : crumbs)
        is_apart &= other.slot >= crumb.slot || std::hypot(other.position.x - crumb.position.x,
                                                           other.position.y - crumb.position.y) >= 1.5;
      for (const state::Louse& louse : game.world().lice())
        is_apart &=
            std::hypot(louse.position.x - crumb.position.x, louse.position.y - crumb.position.y) > 2.4;
      good += is_apart;
    }
    CHECK(good >= (slots * 9 + 9) / 10);
    game.step();
    CHECK(game.rules().changed() == 0);
  }
}

TEST_CASE("where a crumb lies follows from the hash and its slot alone") {
  Game game(level_map(forage(R"("crumbs":20,"summits":0)")), state::Mode::kForage);
  game.join(1, {19, 19});
  game.begin();
  // Of the step before play begins.
  const std::uint64_t hash = core::stable_hash(std::to_string(game.tick() - 1));
  std::vector<core::Vec2> before;
  for (const ShownCrumb& crumb : game.rules().crumbs()) {
    char bytes[16];
    for (int k = 0; k < 8; ++k) {
      bytes[k] = static_cast<char>(hash >> (8 * k));
      bytes[8 + k] = static_cast<char>(std::uint64_t{crumb.slot} >> (8 * k));
    }
    core::Random random(core::stable_hash({bytes, 16}));
    random.next();  // whether it lies on a summit
    core::Vec2 place;
    for (int k = 0; k < 16; ++k) {
      place.x = static_cast<double>(-19456 + static_cast<std::int64_t>(random.next() % 38913)) / 1024.0;
      place.y = static_cast<double>(-19456 + static_cast<std::int64_t>(random.next() % 38913)) / 1024.0;
      const auto is_far = [&](core::Vec2 other, double distance) {
        return std::hypot(other.x - place.x, other.y - place.y) >= distance;
      };
      if (is_far({19, 19}, 2.5) &&
          std::all_of(before.begin(), before.end(), [&](core::Vec2 other) { return is_far(other, 1.5); }))
        break;
    }
    CHECK(crumb.position == place);
    before.push_back(place);
  }
}

TEST_CASE("crumbs worth three lie on summits, as many as the mode says, and not where a louse stands") {
  const std::string rows = "[0,0,0,0,0],[0,3,0,4,0],[0,0,0,0,0],[0,2,0,5,0],[0,0,0,0,0]";
  Game game(R"({"name":"m","terrain":{"origin":[0,0],"spacing":10,"heights":[)" + rows +
                R"(]},"physics":{"friction":9},)" +
                forage(R"("crumbs":8,"summits":2,"round_s":3,"podium_s":1)") + "}",
            state::Mode::kForage);
  game.join(1, {10, 10});
  std::set<std::pair<double, double>> summits;
  int high = 0, all = 0;
  for (int round = 0; round < 200; ++round) {
    while (game.rules().round().phase != Phase::kPlay) game.step();
    std::set<std::pair<double, double>> taken;
    for (const ShownCrumb& crumb : game.rules().crumbs()) {
      ++all;
      if (crumb.value != 3) continue;
      ++high;
      summits.insert({crumb.position.x, crumb.position.y});
      CHECK(taken.insert({crumb.position.x, crumb.position.y}).second);
    }
    while (game.rules().round().phase == Phase::kPlay) game.step();
  }
  CHECK(summits == std::set<std::pair<double, double>>{{30, 10}, {10, 30}, {30, 30}});
  CHECK(static_cast<double>(high) / all == Approx(0.25).margin(0.04));
}
