#include "shared/rules/crumb_map.h"

#include <bit>
#include <catch2/catch.hpp>
#include <vector>

#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::rules;

TEST_CASE("whoever is near a crumb finds it in his cell, over seams too") {
  constexpr double kNear = 1.9;
  const terrain::Rectangle domain{-20, -7, 25, 30};
  core::Random random(11);
  const auto place = [&] {
    return core::Vec2{domain.x_min + random.uniform() * (domain.x_max - domain.x_min),
                      domain.y_min + random.uniform() * (domain.y_max - domain.y_min)};
  };
  for (const Images& images : {Images({0.0, 0.0}), Images({45.0, 37.0})}) {
    CrumbMap map(domain, images, kNear);
    std::size_t near = 0, looked_at = 0;
    for (int round = 0; round < 200; ++round) {
      map.clear();
      std::vector<core::Vec2> crumbs;
      for (std::uint32_t slot = 0; slot < 64; ++slot) map.add(slot, crumbs.emplace_back(place()));
      for (int k = 0; k < 200; ++k) {
        // Half of them at the edges.
        core::Vec2 at = place();
        if (k % 4 == 0) at.x = k % 8 == 0 ? domain.x_min : domain.x_max - 1e-9;
        if (k % 4 == 1) at.y = k % 8 == 1 ? domain.y_min : domain.y_max - 1e-9;
        const std::uint64_t found = map.near(at);
        looked_at += static_cast<std::size_t>(std::popcount(found));
        for (std::uint32_t slot = 0; slot < 64; ++slot) {
          const core::Vec2 way = images.nearest(at, crumbs[slot]) - at;
          if (core::dot(way, way) > kNear * kNear) continue;
          ++near;
          REQUIRE((found >> slot & 1) == 1);
        }
      }
    }
    CHECK(near > 10000);
    CHECK(looked_at < 6 * near);  // so that it is worth the while
  }
}
