#include "shared/physics/surface_motion.h"

#include <catch2/catch.hpp>

#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;

namespace {

struct Case {
  terrain::SurfaceSample s;
  core::Vec2 v;
  Drive drive;
  state::Parameters p;
};

Case random_case(core::Random& random) {
  const auto u = [&] { return 2.0 * random.uniform() - 1.0; };
  const double angle = 3.0 * u();
  return {{u(), 2 * u(), 2 * u(), 3 * u(), 3 * u(), 3 * u()},
          {2 * u(), 2 * u()},
          {{std::cos(angle), std::sin(angle)}, 1.0, 1.0 + u(), u(), {}},
          {.gravity = 9.81, .drag = 1.0 + u(), .friction = 1.0 + u(), .thrust_max = 1.0}};
}

}  // namespace

TEST_CASE("the power of the forces is the change of energy: dE/dt = F.v exactly") {
  core::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    const auto& s = c.s;
    const core::Vec2 a = acceleration<Forces<true, true, true>>(s, c.v, c.drive, c.p);
    // E = |v|3^2 / 2 + g z along the motion.
    const double vz = s.zx * c.v.x + s.zy * c.v.y;
    const double az = s.zx * a.x + s.zy * a.y + curvature_along(s, c.v);
    const double rate = dot(c.v, a) + vz * az + c.p.gravity * vz;
    const double w = std::sqrt(1 + s.zx * s.zx + s.zy * s.zy);
    const double normal = (c.p.gravity + curvature_along(s, c.v)) / w;
    const double speed = std::sqrt(squared_length_in_space(s, c.v));
    const double rise = s.zx * c.drive.direction.x + s.zy * c.drive.direction.y;
    const double push = c.drive.push * (dot(c.drive.direction, c.v) + rise * vz) / std::sqrt(1 + rise * rise);
    const double power =
        -c.p.drag * speed * speed - c.p.friction * std::fabs(normal) * speed + c.drive.along * speed + push;
    REQUIRE(rate == Approx(power).margin(1e-10));
  }
}

TEST_CASE("the acceleration solves the Lagrangian equations with the full mass matrix") {
  // (1 + zx^2) ax + zx zy ay = -zx (g + v'Hv) + Qx, likewise y; Q = generalised forces of drag and push.
  core::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    const auto& s = c.s;
    const core::Vec2 a =
        acceleration<Forces<true, false, true>>(s, c.v, {c.drive.direction, 1.0, c.drive.push, 0.0, {}}, c.p);
    const double lift = c.p.gravity + curvature_along(s, c.v);
    const double vz = s.zx * c.v.x + s.zy * c.v.y;
    const double rise = s.zx * c.drive.direction.x + s.zy * c.drive.direction.y;
    const double f = c.drive.push / std::sqrt(1 + rise * rise);
    const double force_z = -c.p.drag * vz + f * rise;
    const double qx = -c.p.drag * c.v.x + f * c.drive.direction.x + s.zx * force_z;
    const double qy = -c.p.drag * c.v.y + f * c.drive.direction.y + s.zy * force_z;
    REQUIRE((1 + s.zx * s.zx) * a.x + s.zx * s.zy * a.y == Approx(-s.zx * lift + qx).margin(1e-10));
    REQUIRE((1 + s.zy * s.zy) * a.y + s.zx * s.zy * a.x == Approx(-s.zy * lift + qy).margin(1e-10));
  }
}

TEST_CASE("a force that a map does not have changes nothing when it is compiled in") {
  core::Random random(3);
  for (int i = 0; i < 500; ++i) {
    Case c = random_case(random);
    c.p.drag = 0.0;
    c.p.friction = 0.0;
    const Drive none;
    const core::Vec2 all = acceleration<Forces<true, true, true>>(c.s, c.v, none, c.p);
    const core::Vec2 bare = acceleration<Forces<false, false, false>>(c.s, c.v, none, c.p);
    // One division for all quotients: they round otherwise.
    const double size = std::sqrt(dot(bare, bare));
    REQUIRE(all.x == Approx(bare.x).margin(1e-14 * size));
    REQUIRE(all.y == Approx(bare.y).margin(1e-14 * size));
  }
}
