#include "shared/rules/crowd.h"

#include <catch2/catch.hpp>
#include <vector>

#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::rules;

namespace {

std::vector<Crowd::Pair> all_pairs(std::span<const core::Vec2> places, const Images& images,
                                   double distance) {
  std::vector<Crowd::Pair> pairs;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    for (std::uint32_t j = i + 1; j < places.size(); ++j) {
      const core::Vec2 between = images.nearest(places[i], places[j]) - places[i];
      if (core::dot(between, between) < distance * distance) pairs.push_back({i, j, between});
    }
  }
  return pairs;
}

}  // namespace

TEST_CASE("the pairs of a crowd are those that looking at each with each finds, in that order") {
  core::Random random(3);
  std::size_t found = 0;
  for (int round = 0; round < 400; ++round) {
    const double width = 0.5 + 60.0 * random.uniform(), height = 0.5 + 60.0 * random.uniform();
    const double distance = round % 7 == 0 ? 1e-6 : 3.0 * random.uniform() + 1e-3;
    const Images images(round % 2 == 0 ? core::Vec2{width, height} : core::Vec2{});
    const terrain::Rectangle domain{-3, 5, -3 + width, 5 + height};
    Crowd crowd(domain, images, distance);
    for (int again = 0; again < 2; ++again) {
      std::vector<core::Vec2> places(random.next() % 120);
      for (core::Vec2& place : places) {
        place = {domain.x_min + width * random.uniform(), domain.y_min + height * random.uniform()};
        if (random.next() % 5 == 0) place = places.front();
      }
      const auto pairs = crowd.pairs(places);
      const auto expected = all_pairs(places, images, distance);
      REQUIRE(pairs.size() == expected.size());
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        REQUIRE(pairs[k].first == expected[k].first);
        REQUIRE(pairs[k].second == expected[k].second);
        REQUIRE(pairs[k].between == expected[k].between);
      }
      found += pairs.size();
    }
  }
  CHECK(found > 10'000);
}

TEST_CASE("a crowd takes places a little outside the map, and maps far larger than a louse") {
  Crowd crowd({-1e9, -1e9, 1e9, 1e9}, Images({}), 1.6);
  const std::vector<core::Vec2> places = {{-1e9 - 1.0, 0}, {1e9 + 5, 1e9 + 5}, {-1e9, 0}, {1e9 + 5, 1e9 + 6}};
  const auto pairs = crowd.pairs(places);
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[0].first == 0);
  CHECK(pairs[0].second == 2);
  CHECK(pairs[1].first == 1);
  CHECK(pairs[1].second == 3);
}
