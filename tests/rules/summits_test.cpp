#include "shared/rules/summits.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/rules/table.h"

using namespace woodlouse;
using rules::summits_of;

namespace {

/// Rows from the south, a knot each 10 m from (0, 0).
std::string heights(const std::string& rows, const std::string& more = "") {
  return R"({"name":"m","terrain":{"origin":[0,0],"spacing":10,"heights":[)" + rows + "]}" + more + "}";
}

std::vector<core::Vec2> summits(const std::string& text, double margin = 1.0) {
  return summits_of(tests::map_of(text)->definition, margin);
}

}  // namespace

TEST_CASE("summits are the knots higher than all around them, the highest first, none at the edge") {
  const std::string rows = "[0,0,0,0,9],[0,3,0,0,0],[0,0,0,5,0],[0,2,0,0,0],[0,0,0,0,8]";
  CHECK(summits(heights(rows)) == std::vector<core::Vec2>{{30, 20}, {10, 10}, {10, 30}});
  // Within a margin of 10.5 m there is but the middle knot, which is none, and no ring.
  CHECK(summits(heights(rows), 10.5).empty());
  // What is as high as its neighbour is no summit.
  CHECK(summits(heights("[0,0,0,0,0],[0,3,3,0,0],[0,0,0,0,0],[0,0,0,4,0],[0,0,0,0,0]")) ==
        std::vector<core::Vec2>{{30, 30}});
}

TEST_CASE("where the edges wrap, summits go on over the seam") {
  const std::string rows = "[9,0,0,1,9],[0,0,0,0,0],[0,0,5,0,0],[4,0,0,0,4],[9,0,0,1,9]";
  CHECK(summits(heights(rows, R"(,"edges":"wrap")")) == std::vector<core::Vec2>{{0, 0}, {20, 20}});
}

TEST_CASE("a bowl has its rim's highest places, and what is level has none") {
  const std::string bowl = "[8,5,4,5,9],[5,2,1,2,5],[4,1,0,1,4],[5,2,1,3,5],[7,5,4,5,6]";
  CHECK(summits(heights(bowl)) == std::vector<core::Vec2>{{30, 30}, {10, 10}, {30, 10}, {10, 30}});
  CHECK(summits(heights("[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]")).empty());
  CHECK(summits(heights("[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]", R"(,"edges":"wrap")")).empty());
}

TEST_CASE("every named function has what it has: a volcano its crater's rim, a pot its corners") {
  const auto of = [](const std::string& function, const std::string& more) {
    return summits(R"({"name":"m","terrain":{"function":")" + function + "\"}" + more + "}");
  };
  for (const char* surface : {"", R"(,"surface":"function")"}) {
    CHECK(of("parabolic_pot", surface).size() == 4);
    for (const char* function : {"volcano", "hills", "wavy_pot", "waves"}) {
      INFO(function << surface);
      const auto found = of(function, surface);
      CHECK_FALSE(found.empty());
      CHECK(found.size() <= rules::kMaxSummits);
      for (const core::Vec2 summit : found) CHECK((std::abs(summit.x) <= 19.0 && std::abs(summit.y) <= 19.0));
    }
  }
  CHECK(of("waves", R"(,"edges":"wrap")").size() >= of("waves", "").size());
}
