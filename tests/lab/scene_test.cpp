// The pictures of terrain: what stands before what, and what light shows.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>

#include "bench/lab/figures/scene.h"

using namespace woodlouse;
using namespace woodlouse::lab;

namespace {

constexpr std::size_t kWidth = 160, kHeight = 120;
constexpr terrain::Rectangle kSquare{-4.0, -4.0, 4.0, 4.0};
constexpr Colour kGround{0.9, 0.8, 0.7}, kGreen{0.0, 1.0, 0.0};
constexpr double kElevation = 20.0;  // its tangent is 0.364

/// From the south, where the ridge hides what lies north of it.
View from_south(double heights_by = 1.0) { return {-90.0, kElevation, {}, 10.0, heights_by}; }

/// A ridge from west to east, one high and steep to either side.
terrain::SlopeSample ridge(double, double y) {
  const double height = 1.0 - std::fabs(y);
  if (height <= 0.0) return {0.0, 0.0, 0.0};
  return {height, 0.0, y > 0.0 ? -1.0 : 1.0};
}

Scene ridge_scene(const View& view) {
  Scene scene(kWidth, kHeight, 2, view);
  scene.add_terrain(kSquare, 64, ridge, ridge, kGround);
  return scene;
}

/// The image's bytes, red green blue, from the lowest row on.
std::string image_of(const Scene& scene) {
  const std::string script = scene.plot();
  constexpr std::size_t kBytes = 3 * kWidth * kHeight;
  REQUIRE(script.size() > kBytes);
  REQUIRE(script.back() == '\n');
  return script.substr(script.size() - 1 - kBytes, kBytes);
}

std::size_t green_pixels(const Scene& scene) {
  const std::string image = image_of(scene);
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.size(); i += 3)
    count += image[i] == 0 && image[i + 1] == static_cast<char>(0xff) && image[i + 2] == 0 ? 1 : 0;
  return count;
}

std::size_t colours_of(const terrain::SlopeSample& everywhere) {
  Scene scene(kWidth, kHeight, 1, from_south());
  const Heights heights = [&](double x, double y) {
    return terrain::SlopeSample{everywhere.zx * x + everywhere.zy * y, everywhere.zx, everywhere.zy};
  };
  scene.add_terrain(kSquare, 8, heights, heights, kGround);
  const std::string image = image_of(scene);
  std::set<std::string> colours;
  for (std::size_t i = 0; i < image.size(); i += 3) colours.insert(image.substr(i, 3));
  return colours.size();
}

}  // namespace

TEST_CASE("a ridge hides as much as it is high") {
  // Seen along the tangent 0.364, its shadow on flat ground reaches 1 / 0.364 = 2.75 behind it.
  const Scene scene = ridge_scene(from_south());
  for (const double x : {-3.0, 0.0, 2.5}) {
    CHECK_FALSE(scene.hides({x, -2.0, 0.0}));
    CHECK_FALSE(scene.hides({x, -0.5, 0.5}));
    CHECK(scene.hides({x, 0.5, 0.5}));
    CHECK(scene.hides({x, 2.2, 0.0}));
    CHECK_FALSE(scene.hides({x, 3.2, 0.0}));
    CHECK_FALSE(scene.hides({x, 2.2, 1.0}));
  }
  CHECK_FALSE(scene.hides({0.0, 100.0, 0.0}));  // outside of the picture nothing is hidden
}

TEST_CASE("heights drawn higher hide more") {
  CHECK_FALSE(ridge_scene(from_south()).hides({0.0, 3.2, 0.0}));
  CHECK(ridge_scene(from_south(2.0)).hides({0.0, 3.2, 0.0}));
}

TEST_CASE("of a line that is tested only what stands before the ground is drawn") {
  const std::vector<Place> before = {{-3.0, -2.0, 0.0}, {3.0, -2.0, 0.0}};
  const std::vector<Place> behind = {{-3.0, 2.2, 0.0}, {3.0, 2.2, 0.0}};
  for (const auto depth : {Scene::Depth::kTested, Scene::Depth::kIgnored}) {
    Scene scene = ridge_scene(from_south());
    CHECK(green_pixels(scene) == 0);
    scene.add_line(behind, kGreen, 3.0, depth);
    CHECK((green_pixels(scene) > 0) == (depth == Scene::Depth::kIgnored));
    const std::size_t already = green_pixels(scene);
    scene.add_line(before, kGreen, 3.0, depth);
    CHECK(green_pixels(scene) > already + 80);  // six of ten metres across
  }
}

TEST_CASE("a plane has one light") {
  for (const auto& slope : {terrain::SlopeSample{0.0, 0.0, 0.0}, terrain::SlopeSample{0.0, 0.3, -0.2}})
    CHECK(colours_of(slope) == 2);  // and the background
}

TEST_CASE("facets go through the knots and are flat between") {
  terrain::HeightGrid grid{3, 3, -1.0, -1.0, 1.0, 1.0, {0.0, 1.0, 4.0, 2.0, 0.5, 3.0, 1.0, 1.0, 2.0}};
  const Heights facets = facets_of(grid);
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = -1.0 + static_cast<double>(i), y = -1.0 + static_cast<double>(j);
      CHECK(facets(x, y).z == Approx(grid.at(i, j)).margin(1e-15));
    }
  }
  const terrain::SlopeSample s = facets(0.5, 0.25);  // between the knots 0.5, 3 and 2
  CHECK(s.z == Approx(0.5 + 0.5 * 2.5 + 0.25 * -1.0));
  CHECK(s.zx == Approx(2.5));
  CHECK(s.zy == Approx(-1.0));
}
