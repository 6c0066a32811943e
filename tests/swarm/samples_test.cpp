#include "bench/swarm/samples.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <vector>

#include "shared/core/random.h"

using namespace std::chrono_literals;
using woodlouse::swarm::Samples;

namespace {

Samples of(const std::vector<int>& milliseconds) {
  Samples samples;
  for (const int ms : milliseconds) samples.add(std::chrono::milliseconds(ms));
  samples.sort();
  return samples;
}

}  // namespace

TEST_CASE("no samples have no percentiles but 0") {
  CHECK(of({}).at(0.5) == 0.0);
  CHECK(of({}).size() == 0);
}

TEST_CASE("one sample is every percentile") {
  for (const double share : {0.0, 0.01, 0.5, 1.0}) CHECK(of({7}).at(share) == 7.0);
}

TEST_CASE("a percentile is the smallest sample that at least that share does not exceed") {
  woodlouse::core::Random random(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<int> values(1 + random.next() % 40);
    for (int& value : values) value = static_cast<int>(random.next() % 20);
    const Samples samples = of(values);
    for (const double share : {0.0, 0.01, 0.5, 0.95, 0.99, 1.0}) {
      const double at = samples.at(share);
      const auto share_up_to = [&](auto is_counted) {
        return static_cast<double>(std::count_if(values.begin(), values.end(), is_counted)) /
               static_cast<double>(values.size());
      };
      CHECK(std::count(values.begin(), values.end(), static_cast<int>(at)) > 0);
      CHECK(share_up_to([&](int value) { return value <= at; }) >= share);
      if (at > *std::min_element(values.begin(), values.end())) {
        CHECK(share_up_to([&](int value) { return value < at; }) < share);
      }
    }
  }
}

TEST_CASE("durations are kept in milliseconds, fractions too, and lists add up") {
  Samples some;
  some.add(1500us);
  Samples others;
  others.add(250us);
  others.add(2s);
  some.add(others);
  some.sort();
  CHECK(some.size() == 3);
  CHECK(some.at(0.0) == 0.25);
  CHECK(some.at(0.5) == 1.5);
  CHECK(some.at(1.0) == 2000.0);
}
