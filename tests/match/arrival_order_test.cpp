// What decides a match is the step an input is for, its player and its number; not when in the time before,
// nor behind whose, it came in. Only the inputs of one player keep their own order, as his connection keeps
// it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/match/match.h"

using namespace woodlouse;
using namespace woodlouse::match;

namespace {

constexpr std::uint64_t kTicks = 240;
constexpr PlayerId kPlayers = 7;

std::shared_ptr<const map::Map> hills() {
  const auto map = map::parse_map(
      R"({"name":"hills","terrain":{"function":"hills"},"physics":{"thrust_max":6}})", "hills", {});
  REQUIRE(map);
  return *map;
}

/// By player, each with its inputs by seq: up to three for a tick, some for later ticks than the next one's.
std::vector<std::vector<Input>> planned_inputs() {
  core::Random random(77);
  std::vector<std::vector<Input>> plan(kPlayers);
  for (PlayerId player = 1; player <= kPlayers; ++player) {
    for (std::uint64_t tick = 1; tick < kTicks - 30; ++tick) {
      for (std::uint64_t n = random.next() % 4; n > 0; --n) {
        Input input;
        input.player = player;
        input.seq = static_cast<std::uint32_t>(plan[player - 1].size() + 1);
        input.thrust = {state::ThrustKind::kMapVector,
                        {0.7 * random.uniform() - 0.35, 0.7 * random.uniform() - 0.35}};
        if (random.next() % 2 == 0)
          input.thrust = {state::ThrustKind::kAlongHeading, {2.0 * random.uniform() - 1.0, 0.0}};
        if (random.next() % 3 == 0) input.ticks = static_cast<std::uint32_t>(1 + random.next() % 20);
        input.wanted_tick = tick + random.next() % 20;
        plan[player - 1].push_back(input);
      }
    }
  }
  return plan;
}

/// The same inputs by the tick in which they come in: none after its step, each player's in their order, all
/// else by chance.
std::map<std::uint64_t, std::vector<Input>> shuffled(const std::vector<std::vector<Input>>& plan,
                                                     std::uint64_t seed) {
  core::Random random(seed);
  std::map<std::uint64_t, std::vector<Input>> arrivals;
  for (const std::vector<Input>& inputs : plan) {
    std::vector<std::uint64_t> latest(inputs.size());
    std::uint64_t bound = kTicks;
    for (std::size_t k = inputs.size(); k-- > 0;) latest[k] = bound = std::min(bound, inputs[k].wanted_tick);
    std::uint64_t arrival = 0;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      arrival = std::max(arrival, latest[k] - std::min(latest[k], random.next() % 40));
      std::vector<Input>& tick = arrivals[arrival];
      // Behind the player's own, anywhere between the others'.
      std::size_t place = tick.size();
      while (place > 0 && tick[place - 1].player != inputs[k].player && random.next() % 3 != 0) --place;
      tick.insert(tick.begin() + static_cast<std::ptrdiff_t>(place), inputs[k]);
    }
  }
  return arrivals;
}

std::vector<std::uint64_t> hashes_of(const std::shared_ptr<const map::Map>& map,
                                     const std::map<std::uint64_t, std::vector<Input>>& arrivals) {
  Match match(map, {60, 5});
  for (PlayerId player = 1; player <= kPlayers; ++player) match.join();
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
    const auto found = arrivals.find(tick);
    if (found != arrivals.end()) {
      for (const Input& input : found->second) {
        const Filed filed = match.file(input);
        REQUIRE(filed.outcome == Filed::Outcome::kFiled);
        REQUIRE(filed.tick == input.wanted_tick);
      }
    }
    hashes.push_back(match.advance().hash);
  }
  return hashes;
}

}  // namespace

TEST_CASE("when and in which order inputs come in before their step changes no hash of any tick") {
  const auto map = hills();
  const auto plan = planned_inputs();
  const auto reference_arrivals = shuffled(plan, 0);
  const auto reference = hashes_of(map, reference_arrivals);
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const auto arrivals = shuffled(plan, seed);
    std::size_t moved = 0;
    for (const auto& [tick, inputs] : arrivals) {
      const auto found = reference_arrivals.find(tick);
      const auto is_same = [](const Input& a, const Input& b) {
        return a.player == b.player && a.seq == b.seq;
      };
      if (found == reference_arrivals.end() ||
          !std::equal(inputs.begin(), inputs.end(), found->second.begin(), found->second.end(), is_same))
        ++moved;
    }
    REQUIRE(moved > kTicks / 2);
    REQUIRE(hashes_of(map, arrivals) == reference);
  }
}

TEST_CASE("which of a player's own inputs comes first does change the hash") {
  const auto map = hills();
  auto plan = planned_inputs();
  const auto reference = hashes_of(map, shuffled(plan, 0));
  std::vector<Input>& inputs = plan.front();
  const auto twins = std::adjacent_find(inputs.begin(), inputs.end(), [](const Input& a, const Input& b) {
    return a.wanted_tick == b.wanted_tick && a.thrust != b.thrust;
  });
  REQUIRE(twins != inputs.end());
  std::swap(twins->thrust, std::next(twins)->thrust);
  CHECK(hashes_of(map, shuffled(plan, 0)) != reference);
}
