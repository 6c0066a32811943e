// The prediction against the server's own match: the same map, the same inputs, the same bits.
#include "client/play/prediction.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>

#include "client/play/pilot.h"
#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/match/match.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

constexpr std::uint32_t kTickHz = 60;

std::shared_ptr<const map::Map> map_of(const char* name) {
  auto loaded = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/" + name + ".json");
  REQUIRE(loaded);
  return *loaded;
}

/// What a client has: the map as the wire brought it, in a memory of its own.
std::shared_ptr<const map::Map> over_the_wire(const map::Map& original) {
  auto parsed = map::parse_map(original.canonical, "the wire", {});
  REQUIRE(parsed);
  return *parsed;
}

protocol::ExactState exact(const state::Louse& louse, std::uint64_t tick) { return {tick, louse}; }

bool same_bits(const state::Louse& a, const state::Louse& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

ThrustOrder random_order(core::Random& random) {
  const std::uint32_t ticks = 1 + static_cast<std::uint32_t>(random.next() % 40);
  if (random.next() % 4 == 0) return {{state::ThrustKind::kAlongHeading, {-1.0, 0.0}}, ticks};
  if (random.next() % 5 == 0) return {{state::ThrustKind::kMapVector, {}}, 1};
  const double angle = random.uniform() * 6.283;
  return {{state::ThrustKind::kMapVector, wire_vector({std::cos(angle), std::sin(angle)})}, ticks};
}

match::Input filed(match::PlayerId player, std::uint32_t seq, std::uint64_t tick, const ThrustOrder& order) {
  return {.player = player, .seq = seq, .thrust = order.thrust, .ticks = order.ticks, .wanted_tick = tick};
}

/// A server with one player among bots, its acks delayed by `delay` ticks.
struct Game {
  match::Match match;
  match::PlayerId player;
  std::uint64_t delay;
  std::map<std::uint64_t, std::uint32_t> expected;           // tick -> seq of the input it takes
  std::deque<std::pair<std::uint64_t, protocol::Ack>> acks;  // when it arrives, what

  Game(std::shared_ptr<const map::Map> map, std::uint64_t ack_delay)
      : match(std::move(map), {.tick_hz = kTickHz, .seed = 11}), player(match.join()), delay(ack_delay) {
    match.join();
    match.advance();
  }
  const state::Louse& louse() const { return *match.world().find(player); }

  std::uint64_t submit(std::uint32_t seq, std::uint64_t tick, const ThrustOrder& order) {
    const match::Filed result = match.file(filed(player, seq, tick, order));
    REQUIRE(result.outcome == match::Filed::Outcome::kFiled);
    expected[result.tick] = seq;
    return result.tick;
  }
  void advance() {
    const std::uint64_t tick = match.tick();
    match.advance();
    if (const auto taken = expected.find(tick); taken != expected.end()) {
      protocol::Ack ack;
      ack.seq = taken->second;
      ack.tick = tick;
      ack.you = exact(louse(), tick + 1);
      acks.emplace_back(tick + 1 + delay, ack);
    }
  }
  std::vector<protocol::Ack> arrived() {
    std::vector<protocol::Ack> result;
    while (!acks.empty() && acks.front().first <= match.tick()) {
      result.push_back(acks.front().second);
      acks.pop_front();
    }
    return result;
  }
};

}  // namespace

TEST_CASE(
    "where inputs land as asked the prediction equals the server's world bit for bit, ahead of every ack") {
  for (const char* name : {"volcano", "hills", "parabolic_pot", "wavy_pot", "torus", "arena"}) {
    const auto map = map_of(name);
    Game game(map, 9);
    const auto own = over_the_wire(*map);
    REQUIRE(own->hash == map->hash);
    Prediction prediction(*own, kTickHz);
    core::Random random(5);

    // The first ack comes from a neutral input, as a client's first does.
    prediction.sent(1, game.match.tick(), {{state::ThrustKind::kMapVector, {}}, 1});
    game.submit(1, game.match.tick(), {{state::ThrustKind::kMapVector, {}}, 1});
    game.advance();
    prediction.acknowledge(game.acks.front().second);
    game.acks.clear();

    // The client lives 10 ticks ahead; its inputs ask for the tick it is at.
    std::map<std::uint64_t, state::Louse> believed;
    constexpr std::uint64_t kAhead = 10;
    std::uint32_t seq = 1;
    int compared = 0;
    for (int i = 0; i < 1500; ++i) {
      for (const protocol::Ack& ack : game.arrived()) {
        prediction.acknowledge(ack);
        REQUIRE(prediction.take_correction() == core::Vec2{});
      }
      const std::uint64_t here = game.match.tick() + kAhead;
      prediction.advance(here);
      believed[here] = *prediction.louse();
      if (random.next() % 6 == 0) {
        const ThrustOrder order = random_order(random);
        prediction.sent(++seq, here, order);
        REQUIRE(game.submit(seq, here, order) == here);
      }
      game.advance();
      if (const auto then = believed.find(game.match.tick()); then != believed.end()) {
        REQUIRE(same_bits(then->second, game.louse()));
        ++compared;
      }
    }
    REQUIRE(compared > 1400);
  }
}

TEST_CASE("inputs that land later than asked are corrected by their ack, to the bit") {
  const auto map = map_of("volcano");
  Game game(map, 4);
  Prediction prediction(*map, kTickHz);
  core::Random random(9);
  prediction.sent(1, game.match.tick(), {{state::ThrustKind::kMapVector, {}}, 1});
  game.submit(1, game.match.tick(), {{state::ThrustKind::kMapVector, {}}, 1});
  std::uint32_t seq = 1;
  for (int i = 0; i < 600; ++i) {
    const std::uint64_t here = game.match.tick() + 2;
    prediction.advance(here);
    if (i % 20 == 5) {
      const ThrustOrder order = random_order(random);
      prediction.sent(++seq, here, order);
      game.submit(seq, here + 3, order);  // three ticks late
    }
    game.advance();
    for (const protocol::Ack& ack : game.arrived()) prediction.acknowledge(ack);
    if (i % 20 == 19) {  // everything is answered by now
      REQUIRE(prediction.pending() == 0);
      Prediction copy = prediction;
      copy.advance(game.match.tick());
      while (game.match.tick() < copy.tick()) game.advance();
      REQUIRE(same_bits(*copy.louse(), game.louse()));
    }
  }
}

TEST_CASE("a dropped input is taken out of the prediction by its ack") {
  const auto map = map_of("parabolic_pot");
  Game game(map, 0);
  Prediction prediction(*map, kTickHz);
  prediction.sent(1, game.match.tick(), {{state::ThrustKind::kMapVector, {}}, 1});
  game.submit(1, game.match.tick(), {{state::ThrustKind::kMapVector, {}}, 1});
  game.advance();
  prediction.acknowledge(game.acks.front().second);
  game.acks.clear();
  prediction.sent(2, prediction.tick(), {{state::ThrustKind::kMapVector, {1.0, 0.0}}, 60});
  prediction.sent(3, prediction.tick() + 5, {{state::ThrustKind::kMapVector, {}}, 1});
  game.submit(3, prediction.tick() + 5, {{state::ThrustKind::kMapVector, {}}, 1});
  prediction.advance(game.match.tick() + 8);
  protocol::Ack dropped;
  dropped.seq = 2;
  dropped.dropped = true;
  prediction.acknowledge(dropped);
  for (int i = 0; i < 8; ++i) game.advance();
  prediction.acknowledge(game.acks.front().second);
  REQUIRE(same_bits(*prediction.louse(), game.louse()));
}

TEST_CASE("nothing is believed before the first ack, nor after forgetting") {
  const auto map = map_of("volcano");
  Prediction prediction(*map, kTickHz);
  prediction.advance(1000);
  REQUIRE(prediction.louse() == nullptr);
  Game game(map, 0);
  protocol::Ack ack;
  ack.you = exact(game.louse(), game.match.tick());
  prediction.acknowledge(ack);
  REQUIRE(prediction.louse() != nullptr);
  prediction.forget();
  REQUIRE(prediction.louse() == nullptr);
  REQUIRE_FALSE(prediction.position_at(game.match.tick()));
}

TEST_CASE("a client that was suspended for minutes starts anew instead of running them all") {
  const auto map = map_of("volcano");
  Prediction prediction(*map, kTickHz);
  Game game(map, 0);
  protocol::Ack ack;
  ack.you = exact(game.louse(), game.match.tick());
  prediction.acknowledge(ack);
  prediction.advance(1'000'000'000);
  REQUIRE(prediction.louse() == nullptr);
}

TEST_CASE("an ack after a pause puts the louse where it is, and what was sent meanwhile still waits") {
  const auto map = map_of("volcano");
  Prediction prediction(*map, kTickHz);
  Game game(map, 0);
  protocol::Ack ack;
  ack.you = exact(game.louse(), game.match.tick());
  prediction.acknowledge(ack);
  const std::uint64_t later = prediction.tick() + 10 * Prediction::kMaxAheadTicks;
  prediction.sent(7, later + 2, {});
  ack.seq = 6;
  ack.you->tick = later;
  prediction.acknowledge(ack);
  REQUIRE(prediction.louse() != nullptr);
  CHECK(prediction.tick() == later);
  CHECK(prediction.pending() == 1);
}

TEST_CASE("late acks widen the lead, early ones narrow it, both within bounds") {
  Lead lead(kTickHz);
  const double before = lead.ticks(0.0);
  protocol::Ack late;
  late.late = true;
  lead.observe(late);
  REQUIRE(lead.ticks(0.0) == Approx(before + 1.0));
  for (int i = 0; i < 100; ++i) lead.observe(late);
  REQUIRE(lead.ticks(0.0) <= 30.0);
  protocol::Ack early;
  early.margin_us = 500'000;
  for (int i = 0; i < 1000; ++i) lead.observe(early);
  REQUIRE(lead.ticks(0.0) == Approx(0.5));
  REQUIRE(lead.ticks(0.15) == Approx(9.5));
}
