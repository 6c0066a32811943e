#include <catch2/catch.hpp>
#include <cmath>

#include "client/drawing/badges.h"
#include "client/drawing/layout.h"
#include "client/drawing/louse_shape.h"
#include "client/drawing/terrain_oblique_view.h"
#include "client/drawing/terrain_top_view.h"
#include "client/ground/oblique_camera.h"
#include "client/ground/relief.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

TEST_CASE("a louse's back is the ground's normal and its nose lies in the ground") {
  core::Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const core::Vec2 gradient{3.0 * (random.uniform() - 0.5), 3.0 * (random.uniform() - 0.5)};
    const double yaw = 6.3 * random.uniform();
    const double exaggeration = 1.0 + random.uniform();
    const physics::Attitude attitude = physics::attitude({std::cos(yaw), std::sin(yaw)}, gradient);
    const LouseShape shape({}, exaggerated(attitude, exaggeration), 1.0);
    const Vec3 normal = normalized({-gradient.x * exaggeration, -gradient.y * exaggeration, 1.0});
    CHECK(length(shape.upward() - normal) < 1e-9);
    CHECK(std::abs(dot(shape.forward(), normal)) < 1e-9);
    CHECK(shape.forward().x * std::sin(yaw) == Approx(shape.forward().y * std::cos(yaw)).margin(1e-9));
  }
}

TEST_CASE("a ray at a louse's nose meets it there, and one past it does not") {
  const LouseShape shape({1.0, 2.0, 3.0}, physics::attitude({0.6, 0.8}, {0.3, -0.5}), 2.0);
  const Vec3 nose = shape.centre() + 2.0 * shape.forward();
  const auto hit = shape.hit(nose + 5.0 * shape.forward(), -1.0 * shape.forward());
  REQUIRE(hit);
  CHECK(hit->way == Approx(5.0));
  CHECK(hit->along == Approx(1.0));
  CHECK(length(hit->normal - shape.forward()) < 1e-9);
  CHECK_FALSE(shape.hit(nose + 5.0 * shape.upward(), shape.forward()));
}

TEST_CASE("the camera sees the whole map in any terminal") {
  for (const auto map : terrain::kFunctionNames) {
    const Relief relief(named_terrain(map));
    for (const Size size : {Size{36, 17}, Size{56, 22}, Size{87, 34}, Size{162, 58}, Size{200, 20}}) {
      const ObliqueCamera camera = oblique_camera_for(relief, size);
      for (double x = -20.0; x <= 20.0; x += 2.5)
        for (double y = -20.0; y <= 20.0; y += 2.5) {
          const auto p = camera.project({x, y, relief.sample({x, y}).z * relief.exaggeration()});
          REQUIRE(p);
          CHECK((p->x >= 0.0 && p->x <= size.columns));
          CHECK((p->y >= 0.0 && p->y <= 2.0 * size.rows));
        }
    }
  }
}

TEST_CASE("a ray through a point's pixel passes through the point") {
  const Relief relief(named_terrain(terrain::FunctionName::kHills));
  const ObliqueCamera camera =
      oblique_camera_around(oblique_camera_for(relief, {87, 34}), {3.0, -4.0, 1.0}, 2.6, {87, 34});
  core::Random random(21);
  for (int i = 0; i < 200; ++i) {
    const Vec3 point{40.0 * random.uniform() - 20.0, 40.0 * random.uniform() - 20.0, 10.0 * random.uniform()};
    const auto pixel = camera.project(point);
    REQUIRE(pixel);
    CHECK(length(camera.eye() + pixel->depth * camera.ray(pixel->x, pixel->y) - point) < 1e-8);
  }
}

TEST_CASE("pots are seen from 55 degrees or more, a hill from about 35") {
  constexpr double kDegree = 3.14159265358979 / 180.0;
  CHECK(camera_tilt(Relief(named_terrain(terrain::FunctionName::kParabolicPot))) >= 55.0 * kDegree);
  CHECK(camera_tilt(Relief(named_terrain(terrain::FunctionName::kWavyPot))) >= 55.0 * kDegree);
  terrain::HeightGrid hill = terrain::sample_function(terrain::FunctionName::kParabolicPot, 20.0, 10);
  for (double& z : hill.heights) z = -z;
  CHECK(camera_tilt(Relief(std::make_shared<terrain::Terrain>(terrain::BicubicSpline(hill)))) ==
        Approx(35.0 * kDegree));
}

TEST_CASE("ground is never darker than the ambient light nor brighter than full light") {
  for (const auto map : terrain::kFunctionNames) {
    const Relief relief(named_terrain(map));
    for (double x = -20.0; x <= 20.0; x += 0.5)
      for (double y = -20.0; y <= 20.0; y += 0.5) {
        const double brightness = relief.brightness({x, y}, relief.sample({x, y}));
        CHECK(brightness >= 0.45);
        CHECK(brightness <= 1.0);
      }
  }
}

TEST_CASE("contours keep three pixels apart on any slope") {
  core::Random random(13);
  for (int i = 0; i < 500; ++i) {
    const double rise = std::exp(6.0 * random.uniform() - 3.0);
    int last = -100;
    for (int x = 0; x < 300; ++x)
      if (contour_shade(rise * x, rise * (x + 1), rise * x, 1.0) < 1.0) {
        CHECK(x - last >= 3);
        last = x;
      }
  }
}

TEST_CASE("a louse behind a ridge is not seen, before it it is") {
  terrain::HeightGrid ridge;
  ridge.columns = ridge.rows = 41;
  ridge.x_origin = ridge.y_origin = -20.0;
  for (std::size_t j = 0; j < 41; ++j)
    for (std::size_t i = 0; i < 41; ++i) {
      const double y = static_cast<double>(j) - 20.0;
      ridge.heights.push_back(16.0 * std::exp(-y * y / 4.0));
    }
  const Relief relief(std::make_shared<terrain::Terrain>(terrain::BicubicSpline(ridge)));
  const Viewport viewport{0, 0, {90, 34}};
  const ObliqueCamera camera = oblique_camera_for(relief, viewport.size);
  const ObliqueLayer layer = oblique_layer(relief, camera, viewport.size, ColorMode::kTruecolor);
  const auto changes = [&](core::Vec2 position) {
    Scene scene;
    scene.look = {ColorMode::kTruecolor, GlyphSet::kHalfBlocks};
    scene.labels = false;
    scene.terrain = relief.shared_terrain();
    LouseMark louse;
    louse.id = 1;
    louse.position = position;
    scene.lice.push_back(louse);
    CellBuffer cells(viewport.size);
    for (int row = 0; row < viewport.size.rows; ++row)
      for (int column = 0; column < viewport.size.columns; ++column)
        cells.at(column, row) = layer.cells[static_cast<std::size_t>(row * viewport.size.columns + column)];
    const CellBuffer before = cells;
    LabelPlacer labels(viewport);
    draw_lice_obliquely(scene, Badges(scene), relief, camera, layer, viewport, labels, cells);
    return !(cells == before);
  };
  CHECK(changes({0.0, -12.0}));
  CHECK_FALSE(changes({0.0, 4.5}));
}

TEST_CASE("your louse shows through another that stands in the same place") {
  const Relief relief(named_terrain(terrain::FunctionName::kWavyPot));
  const Viewport viewport{0, 0, {90, 34}};
  const ObliqueCamera camera = oblique_camera_for(relief, viewport.size);
  const ObliqueLayer layer = oblique_layer(relief, camera, viewport.size, ColorMode::kTruecolor);
  for (const std::uint32_t yours : {1u, 2u}) {
    Scene scene;
    scene.look = {ColorMode::kTruecolor, GlyphSet::kHalfBlocks};
    scene.labels = false;
    scene.terrain = relief.shared_terrain();
    for (const std::uint32_t id : {1u, 2u}) {
      LouseMark louse;
      louse.id = id;
      louse.is_you = id == yours;
      louse.position = {2.0, id == yours ? 3.0 : 2.5};
      scene.lice.push_back(louse);
    }
    CellBuffer cells(viewport.size);
    for (int row = 0; row < viewport.size.rows; ++row)
      for (int column = 0; column < viewport.size.columns; ++column)
        cells.at(column, row) = layer.cells[static_cast<std::size_t>(row * viewport.size.columns + column)];
    LabelPlacer labels(viewport);
    draw_lice_obliquely(scene, Badges(scene), relief, camera, layer, viewport, labels, cells);
    const Color red = Color::of(louse_color(yours, Owner::kYou, scene.look));
    int found = 0;
    for (int row = 0; row < viewport.size.rows; ++row)
      for (const Cell& cell : cells.row(row))
        found += cell.style.foreground == red || cell.style.background == red;
    CHECK(found >= 3);
  }
}
