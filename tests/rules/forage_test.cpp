#include "shared/rules/forage.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/rules/table.h"

using namespace woodlouse;
using namespace woodlouse::rules;
using tests::level_map;

namespace {

using Game = tests::Table<Forage>;

constexpr std::uint64_t kStart = 180;  // play begins, at 60 Hz: 3 s after the first step

struct Lies {
  double x, y;
  std::uint8_t value = 1;
};
struct Plays {
  state::LouseId id;
  std::int64_t score = 0;
  std::uint8_t chain = 0;
  Moment last = 0;
};

std::string forage(const std::string& fields) { return "\"forage\":{" + fields + "}"; }

/// A round in play until that tick, with these crumbs in the first slots and nothing in the others.
void arrange(Game& game, std::uint64_t until, const std::vector<Lies>& lie, const std::vector<Plays>& play) {
  StateWriter out;
  out.put(static_cast<std::uint8_t>(Phase::kPlay));
  out.put(std::uint32_t{1});
  out.put(until);
  for (std::size_t slot = 0; slot < game.rules().slots(); ++slot) {
    const Lies crumb = slot < lie.size() ? lie[slot] : Lies{0, 0, 0};
    out.put(static_cast<std::int64_t>(1024 * crumb.x));
    out.put(static_cast<std::int64_t>(1024 * crumb.y));
    out.put(crumb.value);
    out.put(std::uint64_t{0});
  }
  out.put(static_cast<std::uint32_t>(play.size()));
  std::vector<state::LouseId> ids;
  for (const Plays& player : play) {
    out.put(player.id);
    out.put(player.chain);
    out.put(player.score);
    out.put(player.last);
    ids.push_back(player.id);
  }
  REQUIRE(game.restore(out.bytes(), ids));
}

std::int64_t score(Game& game, state::LouseId id) { return game.rules().standing(id).score; }

}  // namespace

TEST_CASE("a crumb is eaten on the way through its disc, at that moment, and comes back 3 s later") {
  Game game(level_map(forage(R"("crumbs":1,"radius":0.5)")), state::Mode::kForage);
  game.join(1, {-1, 0}, {6, 0});  // 0.1 m a tick
  arrange(game, 10'000, {{0, 0}}, {{1}});
  game.step(4);
  CHECK(game.rules().crumbs().size() == 1);
  game.step(2);  // at the end of the fifth it touches the disc but for rounding
  CHECK(game.rules().crumbs().empty());
  CHECK(game.rules().crumb(0).value == 0);
  const auto eaten = game.said(EventKind::kCrumb);
  REQUIRE(eaten.size() == 1);
  CHECK(eaten[0].louse == 1);
  CHECK(std::abs(static_cast<double>(eaten[0].moment) - 5.0 * 65536) <= 1.0);
  CHECK(eaten[0].values == std::array<std::int64_t, 4>{0, 1, 1, 1});
  CHECK(score(game, 1) == 1);
  const std::uint64_t gone = (eaten[0].moment - 1) / 65536;  // or a tick more
  while (game.rules().crumbs().empty()) game.step();
  CHECK(game.rules().changed() == 1);
  CHECK(game.tick() - gone >= 180);
  CHECK(game.tick() - gone <= 182);
}

TEST_CASE("who passes a crumb's disc, drives away from it or stands beside it eats nothing") {
  Game game(level_map(forage(R"("crumbs":1,"radius":0.5)")), state::Mode::kForage);
  game.join(1, {-5, 0.51}, {300, 0});
  game.join(2, {0.51, 0}, {10, 0});
  game.join(3, {0, -0.51});
  arrange(game, 10'000, {{0, 0}}, {{1}, {2}, {3}});
  game.step(3);
  CHECK(game.rules().crumbs().size() == 1);
  game.put(1, {-2.5, 0.49}, {300, 0});  // through it within a tick
  game.step();
  CHECK(score(game, 1) == 1);
}

TEST_CASE("of several lice the first in the step eats, then who had fewer points, then the smaller id") {
  const auto eater = [](const std::vector<Plays>& play, const std::vector<double>& from) {
    Game game(level_map(forage(R"("crumbs":1,"radius":0.5)")), state::Mode::kForage);
    for (std::size_t k = 0; k < play.size(); ++k)
      game.join(play[k].id, {0, from[k]}, {0, from[k] > 0 ? -60.0 : 60.0});
    arrange(game, 10'000, {{0, 0}}, play);
    game.step();
    const auto eaten = game.said(EventKind::kCrumb);
    REQUIRE(eaten.size() == 1);
    return eaten[0].louse;
  };
  CHECK(eater({{1}, {2}}, {1.25, -1.25}) == 1);
  CHECK(eater({{1}, {2}}, {1.25, -1.125}) == 2);
  CHECK(eater({{1, 5}, {2, 4}}, {1.25, -1.25}) == 2);
  CHECK(eater({{1, 4}, {2, 5}}, {1.25, -1.25}) == 1);
  CHECK(eater({{1, 5}, {2, 4}}, {1.125, -1.25}) == 1);
  // Within: both at the step's start.
  CHECK(eater({{1, 5}, {2, 4}}, {0.125, -0.25}) == 2);
  CHECK(eater({{3}, {7}, {9}}, {1.25, 1.25, -1.25}) == 3);
}

TEST_CASE("all claims of a step are decided by the points before it, then applied as they happened") {
  Game game(level_map(forage(R"("crumbs":3,"radius":0.25)")), state::Mode::kForage);
  // The first eats at 0.25 m of its way, then at 0.75 m at the same moment as the second, who had more points
  // before and has fewer by then.
  game.join(1, {0, 0}, {60, 0});
  game.join(2, {1.0, 1.0}, {0, -60});
  arrange(game, 10'000, {{1.0, 0}, {0.5, 0, 3}}, {{1}, {2, 2}});
  game.step();
  auto eaten = game.said(EventKind::kCrumb);
  REQUIRE(eaten.size() == 2);
  CHECK(eaten[0].louse == 1);
  CHECK(eaten[0].values == std::array<std::int64_t, 4>{1, 3, 1, 3});
  CHECK(eaten[1].louse == 1);
  CHECK(eaten[1].values[0] == 0);
  // The second slot's crumb was the first of its chain though its slot is the higher one.
  CHECK(eaten[1].values == std::array<std::int64_t, 4>{0, 1, 2, 5});
  CHECK(score(game, 2) == 2);
}

TEST_CASE("what follows within 4 s counts twice, then three times, and later it begins anew") {
  const auto play = [](const std::vector<std::uint64_t>& waits) {
    Game game(level_map(forage(R"("crumbs":8,"radius":0.25)")), state::Mode::kForage);
    game.join(1, {-19, 0});
    std::vector<Lies> lie;
    for (std::size_t k = 0; k < waits.size(); ++k) lie.push_back({2.0 * static_cast<double>(k) - 8, 0});
    arrange(game, 100'000, lie, {{1}});
    std::vector<std::int64_t> chains;
    for (std::size_t k = 0; k < waits.size(); ++k) {
      game.put(1, {-19, 0});
      game.step(waits[k] - 1);
      game.put(1, {lie[k].x, lie[k].y});
      game.step();
      for (const Event& event : game.said(EventKind::kCrumb)) {
        if (event.values[0] == static_cast<std::int64_t>(k)) chains.push_back(event.values[2]);
      }
    }
    return chains;
  };
  CHECK(play({10, 240, 240, 240, 240}) == std::vector<std::int64_t>{1, 2, 3, 3, 3});
  CHECK(play({10, 241, 240, 241, 30}) == std::vector<std::int64_t>{1, 1, 2, 1, 2});
}

TEST_CASE("crumbs count twice in the harvest: the last 30 s, or the last third of a shorter round") {
  for (const auto& [seconds, harvest] : {std::pair(180u, 30u), std::pair(90u, 30u), std::pair(60u, 20u)}) {
    Game game(level_map(forage(R"("crumbs":1,"radius":0.5,"round_s":)" + std::to_string(seconds))),
              state::Mode::kForage);
    game.join(1, {-19, 0});
    game.begin();
    const std::uint64_t from = game.rules().round().until - std::uint64_t{60} * harvest;
    CHECK(game.rules().harvest() == from);
    while (game.tick() < from) {
      CHECK(game.said(EventKind::kHarvest).empty());
      game.step();
    }
    const auto said = game.said(EventKind::kHarvest);
    REQUIRE(said.size() == 1);
    CHECK(said[0].moment == from * 65536);
    while (game.rules().crumbs().empty()) game.step();
    game.said(EventKind::kCrumb);
    const std::int64_t before = score(game, 1);
    const auto crumb = game.rules().crumbs()[0];
    game.put(1, crumb.position);
    game.step();
    const auto eaten = game.said(EventKind::kCrumb);
    REQUIRE(eaten.size() == 1);
    CHECK(score(game, 1) == before + 2 * eaten[0].values[1] * eaten[0].values[2]);
    while (game.rules().round().phase == Phase::kPlay) game.step();
    CHECK(game.rules().harvest() == 0);
    CHECK(game.said(EventKind::kHarvest).empty());
  }
}

TEST_CASE("nothing is eaten before play and on the podium, and each round begins at nothing") {
  Game game(level_map(forage(R"("crumbs":20,"radius":5,"round_s":2,"podium_s":2)")), state::Mode::kForage);
  game.join(1, {0, 0}, {4, 3});
  game.step(kStart);
  CHECK(game.said(EventKind::kCrumb).empty());
  game.step();
  REQUIRE(game.rules().round().phase == Phase::kPlay);
  game.step(119);
  CHECK(score(game, 1) > 0);
  CHECK(game.rules().table()[0].score == score(game, 1));
  game.step();
  REQUIRE(game.rules().round().phase == Phase::kPodium);
  game.said(EventKind::kCrumb);
  const std::int64_t reached = score(game, 1);
  game.step(120);
  REQUIRE(game.rules().round().phase == Phase::kCountdown);
  CHECK(score(game, 1) == reached);
  CHECK(game.said(EventKind::kCrumb).empty());
  game.step(kStart);
  REQUIRE(game.rules().round().phase == Phase::kPlay);
  CHECK(game.rules().round().number == 2);
  CHECK(score(game, 1) == 0);
}

TEST_CASE("a crumb beyond the seam is near, for who stands and for who crosses it") {
  Game game(level_map(forage(R"("crumbs":2,"radius":0.5)")).insert(1, R"("edges":"wrap",)"),
            state::Mode::kForage);
  game.join(1, {19.9, 0});
  game.join(2, {19.75, 19.75}, {60, 60});
  arrange(game, 10'000, {{-19.75, 0}, {-19, -19}}, {{1}, {2}});
  game.step();
  const auto eaten = game.said(EventKind::kCrumb);
  REQUIRE(eaten.size() == 2);
  CHECK(eaten[0].louse == 1);
  CHECK(eaten[0].values[0] == 0);
  CHECK(eaten[0].moment == 0);
  CHECK(eaten[1].louse == 2);
  CHECK(eaten[1].values[0] == 1);
  // From 1.25 m to 0.5 m on the diagonal, of 1 m each way.
  const double part = 1.25 - 0.5 / std::sqrt(2.0);
  CHECK(static_cast<double>(eaten[1].moment) == Approx(65536 * part).margin(2));
  // And crumbs lie up to the seam.
  game.step(2000);
  for (int k = 0; k < 40; ++k) {
    for (const ShownCrumb& crumb : game.rules().crumbs()) {
      CHECK((crumb.position.x >= -20 && crumb.position.x < 20));
      game.put(1, crumb.position);
      game.step();
    }
    game.put(1, {0, 0});
    game.step(181);
  }
}

TEST_CASE("who flies more than a metre above the ground eats nothing") {
  Game game(R"({"name":"m","terrain":{"function":"hills"},"physics":{"contact":"unilateral"},)" +
                forage(R"("crumbs":1)") + "}",
            state::Mode::kForage);
  game.join(1, {3, 3});
  arrange(game, 10'000, {{3, 3}}, {{1}});
  state::Louse louse = *game.world().find(1);
  const double ground = game.map().terrain->sample(3, 3).z;
  const auto fly = [&](double above) {
    louse.phase = state::Phase::kFlying;
    louse.flight_z = ground + above;
    game.world().erase(1);
    game.world().insert(louse);
    game.step();
  };
  fly(1.01);
  CHECK(score(game, 1) == 0);
  fly(0.99);
  CHECK(score(game, 1) > 0);
}

TEST_CASE("the table is by points, then by who had them first, then by id, and who left is in it no more") {
  Game game(level_map(forage(R"("crumbs":3,"radius":0.25)")), state::Mode::kForage);
  for (const state::LouseId id : {1u, 2u, 3u, 4u, 5u}) game.join(id, {-19, static_cast<double>(id)});
  arrange(game, 10'000, {}, {{1, 3, 1, 900}, {2, 5, 1, 700}, {3, 5, 1, 600}, {4}, {5}});
  const auto ids = [&] {
    std::vector<state::LouseId> all;
    for (const TableRow& row : game.rules().table()) all.push_back(row.louse);
    return all;
  };
  CHECK(ids() == std::vector<state::LouseId>{3, 2, 1, 4, 5});
  game.rules().leave(3);
  game.world().erase(3);
  game.step();
  CHECK(ids() == std::vector<state::LouseId>{2, 1, 4, 5});
  game.join(6, {-19, 6});
  CHECK(score(game, 6) == 0);
  CHECK(ids() == std::vector<state::LouseId>{2, 1, 4, 5, 6});
}
