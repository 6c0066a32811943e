// Maps whose edges wrap: what is read, kept and refused.
#include <catch2/catch.hpp>
#include <string>

#include "shared/map/map_file.h"
#include "shared/map/map_world.h"

namespace woodlouse::map {
namespace {

std::string error_of(const std::string& rest) {
  const auto map = parse_map("{\"name\":\"m\"," + rest + "}", "m.json", {});
  return map ? std::string("no error") : map.error().text();
}

/// 5 x 4 knots; the last column is the first again, and so is the last row, but for what is said.
std::string heights(const std::string& north_east, const std::string& north_second) {
  return "\"terrain\":{\"spacing\":1,\"heights\":[[0,1,2,1,0],[1,2,3,2,1],[2,0,0,1,2],[0," + north_second +
         ",2,1," + north_east + "]]}";
}

}  // namespace

TEST_CASE("a map that wraps has a periodic spline and says so wherever it is read back") {
  const auto map = parse_map("{\"name\":\"m\"," + heights("0", "1") + ",\"edges\":\"wrap\"}", "m.json", {});
  REQUIRE(map);
  CHECK((*map)->definition.physics.edges == state::Edges::kWrap);
  const auto domain = (*map)->terrain->domain();
  const auto west = (*map)->terrain->sample(domain.x_min, 0.3);
  const auto east = (*map)->terrain->sample(domain.x_max, 0.3);
  CHECK(west.zx == Approx(east.zx).margin(1e-12));
  CHECK(west.zxx == Approx(east.zxx).margin(1e-12));
  CHECK((*map)->canonical.find("\"edges\":\"wrap\"") != std::string::npos);
  const auto again = parse_map((*map)->canonical, "canonical", {});
  REQUIRE(again);
  CHECK((*again)->hash == (*map)->hash);
  CHECK((*again)->definition.physics == (*map)->definition.physics);
}

TEST_CASE("a map with walls is the same map whether it says so or not") {
  const auto silent = parse_map("{\"name\":\"m\"," + heights("0", "1") + "}", "m.json", {});
  const auto said = parse_map("{\"name\":\"m\"," + heights("0", "1") + ",\"edges\":\"walls\"}", "m.json", {});
  REQUIRE((silent && said));
  CHECK((*silent)->hash == (*said)->hash);
  CHECK((*silent)->canonical.find("edges") == std::string::npos);
}

TEST_CASE("any terrain may have open edges, and a map that has them says so wherever it is read back") {
  const auto map =
      parse_map("{\"name\":\"m\"," + heights("0.5", "1.25") + ",\"edges\":\"open\"}", "m.json", {});
  REQUIRE(map);
  CHECK((*map)->definition.physics.edges == state::Edges::kOpen);
  CHECK((*map)->canonical.find("\"edges\":\"open\"") != std::string::npos);
  const auto again = parse_map((*map)->canonical, "canonical", {});
  REQUIRE(again);
  CHECK((*again)->hash == (*map)->hash);
  CHECK((*again)->definition.physics == (*map)->definition.physics);
}

TEST_CASE("who plays hill with edges to fall over has a world with open edges, and no other mode has") {
  const auto map = parse_map(
      R"({"name":"m","terrain":{"function":"hills"},"hill":{"places":[{"at":[0,0]}],"edge":"fall"}})",
      "m.json", {});
  REQUIRE(map);
  CHECK(physics_of((*map)->definition, state::Mode::kRoam) == (*map)->definition.physics);
  CHECK(physics_of((*map)->definition, state::Mode::kHill).edges == state::Edges::kOpen);
  CHECK(make_world(**map, 1.0 / 60, state::Mode::kHill).parameters().edges == state::Edges::kOpen);
  CHECK(make_world(**map, 1.0 / 60).parameters().edges == state::Edges::kWalls);
}

TEST_CASE("heights that do not meet at the seam are refused with the rims and the difference") {
  const std::string east = error_of(heights("0.5", "1") + ",\n\"edges\":\"wrap\"");
  INFO(east);
  CHECK(east.find("m.json:2: edges: the heights of the western and the eastern rim differ by up to 0.5 m") ==
        0);
  CHECK(east.find("make the last column the first again") != std::string::npos);
  const std::string north = error_of(heights("0", "1.25") + ",\n\"edges\":\"wrap\"");
  INFO(north);
  CHECK(north.find(
            "m.json:2: edges: the heights of the southern and the northern rim differ by up to 0.25 m") == 0);
  CHECK(error_of(heights("1e-10", "1") + ",\"edges\":\"wrap\"") == "no error");
}

TEST_CASE(
    "a function wraps where height, slope and curvature meet, on the function itself and on a spline through "
    "it") {
  for (const char* surface : {"spline", "function"}) {
    const auto error = [&](const char* function) {
      return error_of(std::string("\"terrain\":{\"function\":\"") + function + "\"},\"surface\":\"" +
                      surface + "\",\"edges\":\"wrap\"");
    };
    CHECK(error("waves") == "no error");
    // The bowls' heights meet; their slopes do not.
    for (const char* function : {"parabolic_pot", "wavy_pot", "volcano", "hills"}) {
      INFO(function);
      CHECK(error(function).find("does not repeat") != std::string::npos);
    }
  }
}

TEST_CASE("what has an end or a middle can't wrap, and an unknown choice is named") {
  const std::string waves = "\"terrain\":{\"function\":\"waves\"}";
  CHECK(error_of(waves + ",\"surface\":\"natural_spline\",\"edges\":\"wrap\"").find("natural spline") !=
        std::string::npos);
  CHECK(error_of(waves + ",\"edges\":\"wrap\",\"physics\":{\"central_gravity\":1}").find("central gravity") !=
        std::string::npos);
  CHECK(error_of(waves +
                 ",\"edges\":\"wrap\",\"physics\":{\"contact\":\"unilateral\",\"method\":\"precise\"}") ==
        "no error");
  CHECK(error_of(waves + ",\n\"edges\":\"round\"") ==
        "m.json:2: edges: is none of its choices (walls, wrap or open)");
  CHECK(error_of(waves + ",\"edges\":1").find("walls, wrap or open") != std::string::npos);
}

}  // namespace woodlouse::map
