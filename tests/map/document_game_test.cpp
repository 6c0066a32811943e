// Maps that are played by the paper's own equations.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/document/equations.h"
#include "shared/document/game.h"
#include "shared/document/surface_catalogue.h"
#include "shared/map/canonical_map.h"
#include "shared/map/document_surface.h"
#include "shared/map/map_text.h"
#include "shared/map/map_world.h"

using namespace woodlouse;
using namespace woodlouse::map;

namespace {

const std::vector<std::string> kSurfaces = {"spline",  "natural_spline",   "function", "biquadratic",
                                            "blended", "blended_document", "gauss",    "document_spline"};

std::string text_of(const std::string& surface, const std::string& physics,
                    const std::string& terrain = R"({"function":"wavy_pot","grid":10,"scale":20})") {
  return R"({"name":"paper","terrain":)" + terrain + R"(,"surface":")" + surface + R"(","physics":{)" +
         physics + "}}";
}

std::string paper(const std::string& equations) {
  return R"("equations":")" + equations + R"(","method":"false_euler")";
}

std::shared_ptr<const Map> loaded(const std::string& text) {
  const auto map = parse_map(text, "m", nullptr);
  if (!map) FAIL(map.error().text());
  return *map;
}

std::string refusal(const std::string& text) {
  const auto map = parse_map(text, "m", nullptr);
  return map ? "" : map.error().text();
}

state::Louse louse_at(core::Vec2 position, core::Vec2 velocity) {
  state::Louse louse;
  louse.id = 1;
  louse.position = position;
  louse.velocity = velocity;
  louse.phase = state::Phase::kMoving;
  return louse;
}

}  // namespace

TEST_CASE("a room's paper louse takes the paper's steps, to the bit, over each of its surfaces") {
  for (const std::string& surface : kSurfaces) {
    if (!is_of_document(*surface_from_text(surface))) continue;
    for (const auto equations : {state::Equations::kLocalPlane, state::Equations::kAsPrinted}) {
      INFO(surface << " " << to_text(equations));
      const auto map = loaded(text_of(surface, paper(std::string(to_text(equations)))));
      physics::World world = make_world(*map, 1.0 / 60);
      world.insert(louse_at({6.0, -3.0}, {1.5, 2.0}));
      const auto ground =
          document::interpolate(interpolation_of(map->definition.surface), knots_of(map->definition));
      REQUIRE(ground);
      core::Vec2 x{6.0, -3.0};
      core::Vec2 v{1.5, 2.0};
      for (int tick = 0; tick < 120; ++tick) {
        const auto s =
            std::visit([&](const auto& g) { return terrain::SlopeSample{g.sample(x.x, x.y)}; }, *ground);
        using Forces = physics::Forces<true, true, true>;
        const core::Vec2 a =
            equations == state::Equations::kLocalPlane
                ? document::LocalPlane::acceleration<Forces>(s, v, physics::Drive{}, map->definition.physics)
                : document::AsPrinted::acceleration<Forces>(s, v, physics::Drive{}, map->definition.physics);
        v = v + (1.0 / 60) * a;
        x = x + (1.0 / 60) * v;
        world.step();
        REQUIRE(world.lice()[0].position == x);
        REQUIRE(world.lice()[0].velocity == v);
      }
    }
  }
}

TEST_CASE("whatever is pushed over whatever ground, a paper louse stays finite, inside and below its limit") {
  core::Random random(11);
  const std::string cliffs =
      R"({"heights":[[0,150,-150,0,40],[9,-90,190,0,7],[0,0,150,-90,0],[1,150,-150,200,0],[0,2,0,150,0]],"spacing":4})";
  double fastest = 0.0;
  for (const std::string& surface : kSurfaces) {
    for (const char* equations : {"local_plane", "as_printed"}) {
      for (const std::string& ground :
           {std::string(R"({"function":"volcano","grid":6,"scale":20})"), cliffs}) {
        if (surface == "function" && ground == cliffs) continue;
        INFO(surface << " " << equations << " " << ground);
        const auto map =
            loaded(text_of(surface, paper(equations) + R"(,"thrust_max":1000,"edge_restitution":1)", ground));
        for (const int rate : {5, 60, 1000}) {
          physics::World world = make_world(*map, 1.0 / rate);
          const terrain::Rectangle inside = map->terrain->domain();
          for (state::LouseId id = 1; id <= 20; ++id) {
            state::Louse louse = louse_at({inside.x_min + random.uniform() * (inside.x_max - inside.x_min),
                                           inside.y_min + random.uniform() * (inside.y_max - inside.y_min)},
                                          {2000 * (random.uniform() - 0.5), 2000 * (random.uniform() - 0.5)});
            louse.id = id;
            world.insert(louse);
          }
          for (int tick = 0; tick < 200; ++tick) {
            for (state::LouseId id = 1; id <= 20; ++id) {
              if (random.uniform() < 0.1)
                world.set_thrust(
                    id, {state::ThrustKind::kAlongHeading, {random.uniform() < 0.5 ? 1.0 : -1.0, 0.0}}, 30);
            }
            world.step();
            for (const state::Louse& louse : world.lice()) {
              REQUIRE(std::isfinite(louse.distance));
              REQUIRE(inside.contains(louse.position.x, louse.position.y));
              const double speed = std::sqrt(dot(louse.velocity, louse.velocity));
              REQUIRE(speed <= document::kMaxGameSpeed * (1 + 1e-12));
              fastest = std::max(fastest, speed);
            }
          }
        }
      }
    }
  }
  CHECK(fastest > 0.99 * document::kMaxGameSpeed);  // the limit was met
}

TEST_CASE("a paper map is written back as it was read, and its hash tells it from the exact one") {
  for (const std::string& surface : kSurfaces) {
    const auto map = loaded(text_of(surface, paper("as_printed")));
    const auto again = loaded(map->canonical);
    CHECK(again->canonical == map->canonical);
    CHECK(again->hash == map->hash);
    CHECK(again->definition.surface == map->definition.surface);
    CHECK(again->definition.physics == map->definition.physics);
    CHECK(map->hash != loaded(text_of(surface, paper("local_plane")))->hash);
    CHECK(again->terrain->sample(3.1, -2.2).z == map->terrain->sample(3.1, -2.2).z);
  }
}

TEST_CASE(
    "the paper's equations, method and surfaces go together, and a map that mixes them is refused in words") {
  const auto says = [](const std::string& text, const char* words) {
    CHECK_THAT(refusal(text), Catch::Contains(words));
  };
  says(text_of("spline", R"("equations":"as_printed")"), "method\": \"false_euler");
  says(text_of("spline", R"("method":"false_euler")"), "goes with the paper's equations");
  says(text_of("spline", R"("equations":"as_print","method":"false_euler")"),
       "exact, local_plane or as_printed");
  says(text_of("gauss", R"("drag":0.1)"), "the surface gauss has no curvature for the exact equations");
  says(text_of("spline", paper("local_plane") + R"(,"central_gravity":10)"), "know no central gravity");
  says(text_of("spline", paper("local_plane") + R"(,"contact":"unilateral")"), "never leaves the surface");
  says(text_of("document_spline", paper("local_plane"), R"({"function":"hills","grid":32})"),
       "at most 64 a side");
  CHECK(
      refusal(text_of("document_spline", paper("local_plane"), R"({"function":"hills","grid":31})")).empty());
  says(text_of("biquadratc", paper("local_plane")), "biquadratic");
  const std::string wrapping = text_of("spline", paper("local_plane"), R"({"function":"waves","grid":10})");
  CHECK(refusal(wrapping.substr(0, wrapping.size() - 1) + R"(,"edges":"wrap"})").empty());
  const std::string rims = text_of("blended", paper("local_plane"), R"({"function":"waves","grid":10})");
  says(rims.substr(0, rims.size() - 1) + R"(,"edges":"wrap"})", "have rims");
}
