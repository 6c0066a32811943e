// The server's step on the shipped maps, as they are played, against the reference, which shares no code with
// it: a few lice of what `woodlouse-lab precision --only maps` measures.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "bench/lab/game/scene.h"
#include "bench/lab/speed/maps.h"

using namespace woodlouse;
using namespace woodlouse::lab;

TEST_CASE("on every shipped map, however steered, the default at 60 Hz and the reference go the same way") {
  constexpr double kSeconds = 2.0;
  const auto maps = maps_of({});
  REQUIRE(maps.has_value());
  int measured = 0;
  reference::Record met;
  for (const auto& map : *maps) {
    if (!is_measured(*map)) continue;
    ++measured;
    const auto lice = starting_lice(*map, 5, 8);
    for (const Play play : kPlays) {
      std::vector<double> coarse, fine;
      for (const state::Louse& start : lice) {
        for (const int rate : {60, 240}) {
          const auto world = world_of(*map, Integrator::kNystrom4, rate);
          world->restore({&start, 1});
          play_on(*world, play, rate, 0, static_cast<std::uint64_t>(kSeconds * rate));
          const reference::Motion truth = true_way(*map, start, play, rate, kSeconds);
          if (truth.gave_up()) continue;
          (rate == 60 ? coarse : fine).push_back(error_of(*map, world->lice()[0], truth));
          met.lines += truth.record().lines;
          met.walls += truth.record().walls;
          met.seams += truth.record().seams;
          met.stops += truth.record().stops;
        }
      }
      REQUIRE(coarse.size() >= 3);
      REQUIRE(fine.size() >= 3);
      std::sort(coarse.begin(), coarse.end());
      std::sort(fine.begin(), fine.end());
      INFO(map->definition.name << ", " << to_text(play) << ": " << coarse[coarse.size() / 2] << " m, "
                                << fine[fine.size() / 2] << " m");
      CHECK(coarse[coarse.size() / 2] < 5e-4);  // rough ground: maunga_whau's lines lie a metre apart
      CHECK(fine[fine.size() / 2] < 5e-5);
    }
  }
  CHECK(measured == 20);
  // What the step has code for has been on these ways.
  CHECK(met.lines > 1000);
  CHECK(met.walls > 50);
  CHECK(met.seams > 10);
  CHECK(met.stops > 100);
}

TEST_CASE("a thrust is what its play says, whatever the rate") {
  CHECK(thrust_in(Play::kHeldVector, 3, 0) == thrust_in(Play::kHeldVector, 3, 7));
  CHECK_FALSE(thrust_in(Play::kVectorEachTick, 3, 0) == thrust_in(Play::kVectorEachTick, 3, 1));
  CHECK(thrust_in(Play::kPulsedVector, 3, 1).kind == state::ThrustKind::kNone);
  CHECK(thrust_in(Play::kPulsedHeading, 3, 1).value.x == -1.0);
}
