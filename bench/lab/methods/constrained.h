// Methods for constrained motion, which move the mass point in space and let a force along the surface's
// normal hold it there: rivals of the rooms' methods, which move it in the map's plane by the exact
// equations. Gravity alone; a method that has no end within a step, so that it knows neither walls nor
// thrusts.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "shared/core/vec2.h"
#include "shared/document/surface_catalogue.h"
#include "shared/physics/nystrom.h"

namespace woodlouse::lab {

enum class Constrained {
  kRattle,      ///< H. C. Andersen, J. Comput. Phys. 52, 1983. Order 2, symplectic, symmetric
  kRattle4,     ///< composed to order 4 as VerletQ4 is (S. Reich, SIAM J. Numer. Anal. 33, 1996)
  kSymmetric4,  ///< P. Console, E. Hairer, C. Lubich, Numer. Math. 124, 2013: the explicit symmetric
                ///< four-step method of order 4, q4 - 2 q3 + 2 q2 - 2 q1 + q0 = h^2/6 (7 a3 - 2 a2 + 7 a1)
};

inline constexpr std::array kConstrained = {Constrained::kRattle, Constrained::kRattle4,
                                            Constrained::kSymmetric4};

/// rattle, rattle4, symmetric4.
std::string_view to_text(Constrained method);

/// One mass point under way. One thread at a time.
class ConstrainedMotion {
 public:
  ConstrainedMotion() = default;
  ConstrainedMotion(const ConstrainedMotion&) = delete;
  ConstrainedMotion& operator=(const ConstrainedMotion&) = delete;
  virtual ~ConstrainedMotion() = default;
  virtual void step() = 0;
  [[nodiscard]] virtual core::Vec2 position() const = 0;
};

/// h: [s], the same for each step; gravity: [m/s^2]. `surface` must outlive the motion. What a four-step
/// method needs to begin is made of sub-steps as short as kRattle4 is exact with.
/// REQUIRES a function surface or a bicubic spline, and a way that does not leave it.
std::unique_ptr<ConstrainedMotion> make_constrained(const document::AnySurface& surface, Constrained method,
                                                    double gravity, const physics::Motion& start, double h);

}  // namespace woodlouse::lab
