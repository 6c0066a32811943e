// The reference that the lab measures the game by: its order, closed forms, and that it and the server's own
// step, which share no code, agree on every shipped map.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "bench/lab/problems/ski_jump.h"
#include "bench/lab/reference/motion.h"
#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::lab;
using reference::Care;
using reference::Motion;
using reference::Real;
using tests::moving;

namespace {

terrain::Terrain plane(core::Vec2 slope) {
  return terrain::Terrain(terrain::PlaneSurface({-20, -20, 20, 20}, 0.0, slope));
}

Real apart(const Motion& a, const Motion& b) {
  return std::hypot(a.position().x - b.position().x, a.position().y - b.position().y);
}

}  // namespace

TEST_CASE("the reference is of order 8 within a cell") {
  terrain::HeightGrid grid;  // four cells as wide as the way: no line is met
  grid.columns = grid.rows = 5;
  grid.x_origin = grid.y_origin = -40;
  grid.dx = grid.dy = 20;
  core::Random random(5);
  for (int i = 0; i < 25; ++i) grid.heights.push_back(10 * random.uniform());
  const terrain::Terrain ground{terrain::BicubicSpline(grid)};
  const state::Parameters p{.gravity = 9.81, .drag = 0.3, .friction = 0.1, .thrust_max = 4.0};
  const auto rolled = [&](Real h) {
    Motion motion(ground, p, moving({5, 6}, {3, 1}), Care{0, h, false});
    motion.advance(1.6L, {state::ThrustKind::kAlongHeading, {1.0, 0.0}});
    CHECK(motion.record().lines == 0);
    return motion;
  };
  const Motion exact = rolled(0.0125L);
  const Real coarse = apart(rolled(0.2L), exact);
  const Real fine = apart(rolled(0.1L), exact);
  INFO(static_cast<double>(coarse) << " -> " << static_cast<double>(fine));
  CHECK(std::log2(static_cast<double>(coarse / fine)) > 7.3);
}

TEST_CASE("the reference meets a jump's closed form: knot lines, take-off, flight, landing") {
  const terrain::Terrain ground{SkiJump::spline()};
  const state::Parameters p{.gravity = SkiJump::kGravity,
                            .drag = 0.0,
                            .friction = 0.0,
                            .thrust_max = 0.0,
                            .contact = state::SurfaceContact::kUnilateral};
  const Jump jump({-2.0, -1.0}, 1.3, 0.5);
  Motion motion(ground, p, moving(jump.start(), jump.velocity()));
  const double end = jump.landing() + 0.1;
  motion.advance(end, {});
  CHECK(motion.record().take_offs == 1);
  CHECK(motion.record().landings == 1);
  CHECK(std::fabs(static_cast<double>(motion.position().x) - jump.place_after(end).x) < 1e-11);
  CHECK(std::fabs(static_cast<double>(motion.position().y) - jump.place_after(end).y) < 1e-11);
}

TEST_CASE("the reference stops where friction stops, and sets off again where it can't hold") {
  const terrain::Terrain level = plane({0, 0});
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.1, .thrust_max = 0.0};
  Motion sliding(level, p, moving({0, 0}, {3, 4}));
  sliding.advance(20, {});
  CHECK(sliding.rests());
  const double way = 25 / (2 * 0.981);
  CHECK(std::fabs(static_cast<double>(sliding.position().x) - 0.6 * way) < 1e-14);
  CHECK(std::fabs(static_cast<double>(sliding.position().y) - 0.8 * way) < 1e-14);

  // Up a slope that friction can't hold, and down again: z = x / 2, over the map by g (sin +- mu cos) cos.
  const terrain::Terrain slope = plane({0.5, 0});
  Motion returning(slope, p, moving({0, 0}, {2, 0}));
  returning.advance(1.5, {});
  const double cosine2 = 1 / 1.25, up = 9.81 * (0.5 + 0.1) * cosine2, down = 9.81 * (0.5 - 0.1) * cosine2;
  const double turned = 2 / up, since = 1.5 - turned;
  CHECK(std::fabs(static_cast<double>(returning.position().x) - (2 / up - 0.5 * down * since * since)) <
        1e-12);
}

TEST_CASE("the reference bounces, leans and stands in corners as walls are described") {
  // On an incline a wall at x keeps the energy of an elastic impact, and carries who leans on it.
  const terrain::Terrain incline = plane({0.3, 0.2});
  const state::Parameters elastic{
      .gravity = 9.81, .drag = 0.0, .friction = 0.0, .thrust_max = 0.0, .edge_restitution = 1.0};
  Motion ball(incline, elastic, moving({15, 0}, {12, 3}));
  const auto energy = [](const Motion& m) {
    const auto [vx, vy] = m.velocity();
    const Real rise = 0.3L * vx + 0.2L * vy;
    return static_cast<double>(0.5L * (vx * vx + vy * vy + rise * rise) + 9.81L * m.height());
  };
  const double before = energy(ball);
  ball.advance(8, {});
  CHECK(ball.record().walls > 2);
  CHECK(std::fabs(energy(ball) - before) < 1e-12 * before);

  const state::Parameters rough{
      .gravity = 9.81, .drag = 0.0, .friction = 0.05, .thrust_max = 0.0, .edge_restitution = 0.5};
  Motion cornered(incline, rough, moving({-15, -12}, {-3, -1}));
  cornered.advance(30, {});
  CHECK(cornered.rests());
  CHECK(cornered.position().x == -20);
  CHECK(cornered.position().y == -20);
}

TEST_CASE("the reference closes Kepler's ellipse") {
  const terrain::Terrain level = plane({0, 0});
  const state::Parameters p{.gravity = 0.0,
                            .drag = 0.0,
                            .friction = 0.0,
                            .thrust_max = 0.0,
                            .central_gravity = 100.0,
                            .core_radius = 0.2};
  // Semi-major axis 1 / (2 / r - v^2 / k), its period by Kepler's third law.
  const double speed = 2.0, axis = 1 / (2 / 10.0 - speed * speed / 100);
  Motion planet(level, p, moving({10, 0}, {0, speed}));
  planet.advance(2 * 3.14159265358979323846L * std::sqrt(static_cast<Real>(axis) * axis * axis / 100), {});
  CHECK(std::fabs(static_cast<double>(planet.position().x) - 10) < 1e-13);
  CHECK(std::fabs(static_cast<double>(planet.position().y)) < 1e-13);
}
