// Two minutes of the hour that `woodlouse-lab precision --only hour` measures.
#include "bench/lab/game/error_hour.h"

#include <catch2/catch.hpp>

#include "bench/lab/speed/maps.h"

using namespace woodlouse;
using namespace woodlouse::lab;

TEST_CASE("minute by minute six lice have a window of the twin each ten seconds, and one play is one play") {
  const auto maps = maps_of({});
  REQUIRE(maps.has_value());
  for (const auto& map : *maps) {
    if (map->definition.name != "volcano") continue;
    const auto minutes = error_minutes(*map, 2);
    REQUIRE(minutes.size() == 2);
    for (const ErrorMinute& minute : minutes) {
      CHECK(minute.windows == 36);
      CHECK(minute.share > 1.0 / 6);
      CHECK(minute.share < 1.0);
      CHECK(minute.of_play > 1e-8);
      CHECK(minute.of_play < 1e-3);
      CHECK(minute.worst >= minute.of_play / 60.0);
      CHECK(minute.apart_most >= minute.apart_median);
    }
    const auto again = error_minutes(*map, 1);
    CHECK(again[0].of_play == minutes[0].of_play);
    CHECK(again[0].apart_most == minutes[0].apart_most);
  }
}
