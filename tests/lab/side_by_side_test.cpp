#include "bench/lab/report/side_by_side.h"

#include <sched.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bench/lab/report/race.h"

namespace woodlouse::lab {
namespace {

/// On how many cores this thread may run.
int cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(0, sizeof set, &set);
  return CPU_COUNT(&set);
}

TEST_CASE("each piece of work is done once and told of once") {
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    std::vector<int> times(count, 0);
    std::size_t told = 0;
    side_by_side(
        count, [&](std::size_t i) { ++times[i]; }, [&] { ++told; });
    CHECK(times == std::vector<int>(count, 1));
    CHECK(told == count);
  }
}

TEST_CASE("what a piece of work throws comes to who asked, when all that began has ended") {
  std::atomic<int> running{0}, begun{0};
  const auto work = [&](std::size_t i) {
    ++begun;
    ++running;
    const bool fails = i == 3;
    --running;
    if (fails) throw std::runtime_error("the fourth");
  };
  CHECK_THROWS_AS(side_by_side(1000, work, [] {}), std::runtime_error);
  CHECK(running == 0);
  CHECK(begun >= 4);
  std::size_t told = 0;
  CHECK_THROWS_AS(side_by_side(
                      100, [](std::size_t) {},
                      [&] {
                        if (++told == 2) throw std::runtime_error("nobody listens");
                      }),
                  std::runtime_error);
}

TEST_CASE("who is pinned to a core has its work done on all of them, and is pinned again") {
  const int all = cores();
  std::vector<int> at_work(100, 0);
  int before = 0, after = 0;
  std::jthread([&] {  // what it is pinned to dies with it
    pin_to_core();
    before = cores();
    side_by_side(
        at_work.size(), [&](std::size_t i) { at_work[i] = cores(); }, [] {});
    after = cores();
  })
      .join();
  CHECK(before == 1);
  CHECK(at_work == std::vector<int>(at_work.size(), all));
  CHECK(after == 1);
}

}  // namespace
}  // namespace woodlouse::lab
