#include "shared/map/map_file.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "shared/core/joined.h"
#include "shared/core/random.h"
#include "shared/core/stable_hash.h"
#include "shared/json/text.h"
#include "shared/map/canonical_map.h"
#include "shared/map/map_reader.h"
#include "shared/map/spawns.h"

namespace woodlouse::map {
namespace {

std::shared_ptr<const Map> parse(std::string_view text) {
  auto map = parse_map(text, "m.json", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

/// A random map file, any of the ways to say a terrain that need no file beside it.
std::string random_map(core::Random& random) {
  const auto number = [&](double low, double high) {
    return json::double_text(low + (high - low) * random.uniform());
  };
  const auto maybe = [&] { return random.next() % 2 == 0; };
  std::string text = "{\"name\":\"n\\u00e4me \\\"" + std::to_string(random.next() % 100) + "\\\"\"";
  const bool function = maybe();
  std::string surface = maybe() ? "spline" : "natural_spline";
  if (function) {
    if (maybe()) surface = "function";
    text += core::joined({",\"terrain\":{\"function\":\"",
                          terrain::to_text(terrain::kFunctionNames[random.next() % 4]), "\""});
    if (maybe()) text += ",\"grid\":" + std::to_string(2 + random.next() % 20);
    if (maybe()) text += core::joined({",\"scale\":", number(1.0, 100.0)});
    text += "}";
  } else {
    text += ",\"terrain\":{\"spacing\":";
    text += maybe() ? number(0.5, 3) : core::joined({"[", number(0.5, 3), ",", number(0.5, 3), "]"});
    if (maybe()) text += core::joined({",\"origin\":[", number(-50, 50), ",", number(-50, 50), "]"});
    if (maybe()) text += core::joined({",\"scale\":", number(0.5, 5)});
    text += ",\"heights\":[";
    const std::uint64_t columns = 4 + random.next() % 9;
    const std::uint64_t rows = 4 + random.next() % 9;
    for (std::uint64_t j = 0; j < rows; ++j) {
      text += j == 0 ? "[" : ",[";
      for (std::uint64_t i = 0; i < columns; ++i) {
        if (i != 0) text += ',';
        text += random.next() % 8 == 0 ? std::string("-0.0") : number(-3, 3);
      }
      text += "]";
    }
    text += "]}";
  }
  if (maybe()) text += core::joined({",\"surface\":\"", surface, "\""});
  if (maybe()) {
    text +=
        core::joined({",\"physics\":{\"gravity\":", number(0, 1000), ",\"friction\":", number(0, 10), "}"});
  }
  return text + "}";
}

}  // namespace

TEST_CASE("a canonical map is read back as it stands, and any other text is refused") {
  for (const char* surface : {"spline", "function", "natural_spline"}) {
    const auto map = parse(
        core::joined({R"({"name":"m","terrain":{"function":"hills","grid":3},"surface":")", surface, "\"}"}));
    const auto again = parse_canonical_map(map->canonical, "wire");
    REQUIRE(again);
    CHECK((*again)->hash == map->hash);
    CHECK_FALSE(parse_canonical_map(map->canonical + " ", "wire"));
    CHECK_FALSE(parse_canonical_map(map->canonical.substr(1), "wire"));
  }
  const auto sampled = parse_canonical_map(R"({"name":"m","terrain":{"function":"hills"}})", "wire");
  REQUIRE_FALSE(sampled);
  CHECK(sampled.error().text().find("wire: is not a map as a program writes it") == 0);
}

TEST_CASE("a map's canonical text reads back to the same map, bit for bit") {
  core::Random random(11);
  for (int round = 0; round < 400; ++round) {
    const std::string text = random_map(random);
    INFO(text);
    const auto map = parse(text);
    const auto again = parse(map->canonical);
    CHECK(again->canonical == map->canonical);
    CHECK(again->hash == map->hash);
    CHECK(map->hash == core::stable_hash(map->canonical));
    CHECK(map->canonical.find('\n') == std::string::npos);
    CHECK(again->definition.name == map->definition.name);
    CHECK(again->definition.surface == map->definition.surface);
    CHECK(again->definition.physics == map->definition.physics);
    const auto before = knots_of(map->definition);
    const auto after = knots_of(again->definition);
    CHECK(same_bits(after.heights, before.heights));
    CHECK(after.x_origin == before.x_origin);
    CHECK(after.y_origin == before.y_origin);
    CHECK(after.dx == before.dx);
    CHECK(after.dy == before.dy);
    CHECK(again->terrain->domain() == map->terrain->domain());
    REQUIRE(again->definition.spawns.size() == map->definition.spawns.size());
    for (std::size_t k = 0; k < map->definition.spawns.size(); ++k) {
      CHECK(again->definition.spawns[k].position == map->definition.spawns[k].position);
      CHECK(again->definition.spawns[k].heading == map->definition.spawns[k].heading);
    }
    const auto domain = map->terrain->domain();
    for (int k = 0; k < 20; ++k) {
      const double x = domain.x_min + (domain.x_max - domain.x_min) * random.uniform();
      const double y = domain.y_min + (domain.y_max - domain.y_min) * random.uniform();
      CHECK(again->terrain->sample(x, y).z == map->terrain->sample(x, y).z);
      CHECK(again->terrain->sample(x, y).zx == map->terrain->sample(x, y).zx);
    }
  }
}

TEST_CASE("defaults are those of the map format") {
  const auto map = parse(R"({"name":"v","terrain":{"function":"volcano"}})");
  CHECK(map->definition.surface == SurfaceKind::kSpline);
  CHECK(map->definition.physics.gravity == 9.81);
  CHECK(map->definition.physics.drag == 0.2);
  CHECK(map->definition.physics.friction == 0.05);
  CHECK(map->definition.physics.thrust_max == 4.0);
  CHECK(map->definition.physics.edge_restitution == 0.5);
  CHECK(map->terrain->domain() == terrain::Rectangle{-20, -20, 20, 20});
  CHECK(std::holds_alternative<terrain::BicubicSpline>(map->terrain->surface()));
  REQUIRE(map->definition.spawns.size() == 8);
  for (const SpawnPoint& spawn : map->definition.spawns) {
    CHECK(std::hypot(spawn.position.x, spawn.position.y) == Approx(12.0).epsilon(1e-12));
    CHECK(std::abs(core::dot(spawn.heading, spawn.heading) - 1.0) <= 1e-14);
    CHECK(core::dot(spawn.heading, spawn.position) == Approx(-12.0).epsilon(1e-12));  // inwards
  }
}

TEST_CASE("heights that lie in a plane become that plane, whatever spline is asked for") {
  const auto flat =
      parse(R"({"name":"f","terrain":{"heights":[[1,1,1,1],[1,1,1,1],[1,1,1,1],[1,1,1,1]],"spacing":5}})");
  REQUIRE(std::holds_alternative<terrain::PlaneSurface>(flat->terrain->surface()));
  CHECK(flat->terrain->domain() == terrain::Rectangle{-7.5, -7.5, 7.5, 7.5});
  CHECK(flat->terrain->sample(1, 2).z == 1.0);
  const auto ramp = parse(
      R"({"name":"r","terrain":{"heights":[[0,0.1,0.2,0.3],[0,0.1,0.2,0.3],[0,0.1,0.2,0.3],[0,0.1,0.2,0.3]],"spacing":1},"surface":"natural_spline"})");
  REQUIRE(std::holds_alternative<terrain::PlaneSurface>(ramp->terrain->surface()));
  CHECK(ramp->terrain->sample(0, 0).zx == Approx(0.1));
  CHECK(ramp->terrain->sample(0, 0).zxx == 0.0);
  const auto dent = parse(
      R"({"name":"d","terrain":{"heights":[[1,1,1,1],[1,1,1,1],[1,1,1.001,1],[1,1,1,1]],"spacing":5}})");
  CHECK(std::holds_alternative<terrain::BicubicSpline>(dent->terrain->surface()));
}

TEST_CASE("a spline through a function goes through its knots, a function surface is the function") {
  const auto spline = parse(R"({"name":"h","terrain":{"function":"hills","grid":6,"scale":10}})");
  const auto exact =
      parse(R"({"name":"h","terrain":{"function":"hills","grid":6,"scale":10},"surface":"function"})");
  CHECK(std::holds_alternative<terrain::FunctionSurface>(exact->terrain->surface()));
  const auto grid = terrain::sample_function(terrain::FunctionName::kHills, 10.0, 6);
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const double x = std::min(10.0, grid.x_origin + static_cast<double>(i) * grid.dx);
      const double y = std::min(10.0, grid.y_origin + static_cast<double>(j) * grid.dy);
      CHECK(spline->terrain->sample(x, y).z == Approx(grid.at(i, j)).margin(1e-12));
      CHECK(exact->terrain->sample(x, y).z == Approx(grid.at(i, j)).margin(1e-12));
    }
  }
  CHECK(exact->canonical.find("\"function\":\"hills\"") != std::string::npos);
  CHECK(spline->canonical.find("\"heights\"") != std::string::npos);
  CHECK(spline->hash != exact->hash);
}

TEST_CASE("inline heights begin in the south-west and scale lengths and heights alike") {
  const auto map = parse(
      R"({"name":"i","terrain":{"origin":[10,20],"spacing":[1,2],"scale":3,
          "heights":[[1,2,3,4],[5,6,7,8],[9,10,11,12],[13,14,15,16]]}})");
  CHECK(map->terrain->domain() == terrain::Rectangle{30, 60, 39, 78});
  CHECK(map->terrain->sample(30, 60).z == Approx(3));
  CHECK(map->terrain->sample(39, 60).z == Approx(12));
  CHECK(map->terrain->sample(30, 78).z == Approx(39));
  CHECK(map->terrain->sample(39, 78).z == Approx(48));
  const auto centred = parse(
      R"({"name":"i","terrain":{"spacing":2,"heights":[[1,2,3,4],[5,6,7,8],[9,10,11,12],[13,14,15,16]]}})");
  CHECK(centred->terrain->domain() == terrain::Rectangle{-3, -3, 3, 3});
}

TEST_CASE("degrees run counter-clockwise from east and are exact at right angles") {
  CHECK(heading_from_degrees(0) == core::Vec2{1, 0});
  CHECK(heading_from_degrees(90) == core::Vec2{0, 1});
  CHECK(heading_from_degrees(180) == core::Vec2{-1, 0});
  CHECK(heading_from_degrees(-90) == core::Vec2{0, -1});
  CHECK(heading_from_degrees(360) == core::Vec2{1, 0});
  for (double degrees = -360.0; degrees <= 360.0; degrees += 0.37) {
    const core::Vec2 heading = heading_from_degrees(degrees);
    const double radians = degrees * 3.14159265358979323846 / 180.0;
    CHECK(heading.x == Approx(std::cos(radians)).margin(1e-14));
    CHECK(heading.y == Approx(std::sin(radians)).margin(1e-14));
    CHECK(std::abs(core::dot(heading, heading) - 1.0) <= 1e-15);
  }
}

TEST_CASE("a heading may be degrees or a pair of any length") {
  const auto map = parse(R"({"name":"s","terrain":{"function":"volcano"},"spawns":[
      {"position":[1,2],"heading":90},{"position":[-20,20],"heading":[3,-4]},{"position":[0,0]}]})");
  const auto& spawns = map->definition.spawns;
  REQUIRE(spawns.size() == 3);
  CHECK(spawns[0].heading == core::Vec2{0, 1});
  CHECK(spawns[0].position == core::Vec2{1, 2});
  CHECK(spawns[1].heading == core::Vec2{0.6, -0.8});
  CHECK(spawns[2].heading == core::Vec2{1, 0});
}

}  // namespace woodlouse::map

namespace {

std::string flat_map(const std::string& physics, const std::string& spawn = "") {
  return R"({"name":"m","terrain":{"origin":[0,0],"spacing":1,"heights":[[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]]},"physics":{)" +
         physics + R"(},"spawns":[{"position":[1,1])" + spawn + "}]}";
}

}  // namespace

TEST_CASE("contact, method, central gravity and a spawn's speed are read, kept and refused by name") {
  using namespace woodlouse;
  const auto read_twice = [](const std::string& physics) {
    const auto map = map::parse_map(flat_map(physics, R"(,"speed":3.5)"), "m", {});
    REQUIRE(map.has_value());
    const auto again = map::parse_map((*map)->canonical, "canonical", {});
    REQUIRE(again.has_value());
    CHECK((*again)->canonical == (*map)->canonical);
    CHECK((*again)->definition.physics == (*map)->definition.physics);
    CHECK((*map)->definition.spawns.front().speed == 3.5);
    return (*map)->definition.physics;
  };
  CHECK(read_twice(R"("contact":"unilateral")").contact == state::SurfaceContact::kUnilateral);
  CHECK(read_twice(R"("method":"precise")").method == state::Method::kPrecise);
  CHECK(read_twice(R"("central_gravity":2.5)").central_gravity == 2.5);
  CHECK(read_twice(R"("central_gravity":100)").core_radius == Approx(0.2281).margin(1e-4));
  CHECK(read_twice(R"("central_gravity":100,"core_radius":0.5)").core_radius == 0.5);
  CHECK(read_twice("").core_radius == 0.0);
  CHECK(read_twice(R"("tolerance":1e-6)").tolerance == 1e-6);
  CHECK(read_twice(R"("tolerance":-0.0)").tolerance == 0.0);
  CHECK(read_twice("").tolerance == 0.0);

  const auto refusal = [](const std::string& physics, const std::string& spawn = "") {
    const auto refused = map::parse_map(flat_map(physics, spawn), "m", {});
    return refused.has_value() ? std::string() : refused.error().text();
  };
  CHECK(refusal(R"("contact":"loose")").find("m:1: physics.contact") == 0);
  CHECK(refusal(R"("contact":"loose")").find("bilateral or unilateral") != std::string::npos);
  CHECK(refusal(R"("method":1)").find("standard, cheap or precise") != std::string::npos);
  CHECK(refusal(R"("central_gravity":1,"contact":"unilateral")").find("flight knows no pull") !=
        std::string::npos);
  CHECK(refusal(R"("central_gravity":-1)").find("physics.central_gravity") != std::string::npos);
  CHECK(refusal(R"("central_gravity":1,"core_radius":0)").find("physics.core_radius") != std::string::npos);
  CHECK(refusal(R"("core_radius":1)").find("no central gravity to have a core") != std::string::npos);
  CHECK(refusal(R"("tolerance":1.5)").find("m:1: physics.tolerance") == 0);
  CHECK(refusal(R"("tolerance":1e-6,"equations":"local_plane","method":"false_euler")")
            .find("leave tolerance out") != std::string::npos);
  CHECK(refusal("", R"(,"speed":-1)").find("spawns[0].speed") != std::string::npos);
}
