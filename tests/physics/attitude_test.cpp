#include "shared/physics/attitude.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"

using namespace woodlouse;

TEST_CASE("the angles turn forward along the motion in space and up along the surface's normal") {
  core::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double zx = 4 * random.uniform() - 2, zy = 4 * random.uniform() - 2,
                 psi = 6.2 * random.uniform() - 3.1;
    const core::Vec2 heading{std::cos(psi), std::sin(psi)};
    const physics::Attitude a = physics::attitude(heading, {zx, zy});
    CHECK(a.yaw == Approx(psi).margin(1e-12));
    // A41 of chapter 1.3: ground to body.
    const Eigen::Matrix3d to_body = (Eigen::AngleAxisd(a.yaw, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(a.pitch, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(a.roll, Eigen::Vector3d::UnitX()))
                                        .matrix()
                                        .transpose();
    const Eigen::Vector3d normal = Eigen::Vector3d(-zx, -zy, 1).normalized();
    const Eigen::Vector3d forward =
        Eigen::Vector3d(heading.x, heading.y, zx * heading.x + zy * heading.y).normalized();
    CHECK((to_body * normal - Eigen::Vector3d::UnitZ()).norm() < 1e-12);
    CHECK((to_body * forward - Eigen::Vector3d::UnitX()).norm() < 1e-12);
  }
}

TEST_CASE("uphill is a negative pitch") {
  CHECK(physics::attitude({1, 0}, {0.5, 0}).pitch < 0.0);
  CHECK(physics::attitude({-1, 0}, {0.5, 0}).pitch > 0.0);
}
