// The document's equations (chapters 1.1, 1.2, 2.4): a local plane instead of the surface. The exact ones:
// physics/surface_motion.h.
//     (1 + zx^2) ax + zx zy ay = -g zx + fx
//     zx zy ax + (1 + zy^2) ay = -g zy + fy
// solved by Cramer's rule. The term v'Hv is missing from the acceleration and from the normal force; friction
// and thrust are divided by sqrt(|v|3^2 + 1e-4), so that nothing ever sticks.
//     LocalPlane  with Cramer's factors put right: fx (1 + zy^2), fy (1 + zx^2)
//     AsPrinted   with the factors as printed: fx (1 + zx^2), fy (1 + zy^2)
#pragma once

#include <cmath>

#include "shared/physics/surface_motion.h"

namespace woodlouse::document {

enum class CramerFactors { kPutRight, kAsPrinted };

/// Stateless, as a parameter of physics::Stepper; F: the physics::Forces of the map.
template <CramerFactors kFactors>
struct PlaneEquations {
  static constexpr bool kExact = false;

  template <typename F>
  static core::Vec2 acceleration(const terrain::SlopeSample& s, core::Vec2 v, const physics::Drive& drive,
                                 const state::Parameters& p) {
    const double zx2 = s.zx * s.zx;
    const double zy2 = s.zy * s.zy;
    const double zxy = s.zx * s.zy;
    const double vz = s.zx * v.x + s.zy * v.y;
    const double w2 = 1.0 + zx2 + zy2;
    double fx = 0.0;
    double fy = 0.0;
    if constexpr (F::drag) {
      fx -= p.drag * ((1 + zx2) * v.x + zxy * v.y);
      fy -= p.drag * ((1 + zy2) * v.y + zxy * v.x);
    }
    if constexpr (F::singular) {
      const double speed = std::sqrt(v.x * v.x + v.y * v.y + vz * vz + 0.0001);
      double along = drive.along;
      if constexpr (F::friction) along -= p.friction * p.gravity / std::sqrt(w2);
      const double factor = along / speed;
      fx += factor * v.x + factor * vz * s.zx;
      fy += factor * v.y + factor * vz * s.zy;
    }
    if constexpr (F::thrust) {
      if (drive.push > 0.0) {
        const core::Vec2 f = physics::push_over_tangent(s, drive.direction, drive.push);
        const double fz = s.zx * f.x + s.zy * f.y;
        fx += f.x + fz * s.zx;
        fy += f.y + fz * s.zy;
      }
    }
    const double factor_x = kFactors == CramerFactors::kPutRight ? 1 + zy2 : 1 + zx2;
    const double factor_y = kFactors == CramerFactors::kPutRight ? 1 + zx2 : 1 + zy2;
    return {(-p.gravity * s.zx + fx * factor_x - fy * zxy) / w2,
            (-p.gravity * s.zy + fy * factor_y - fx * zxy) / w2};
  }
};

using LocalPlane = PlaneEquations<CramerFactors::kPutRight>;
using AsPrinted = PlaneEquations<CramerFactors::kAsPrinted>;

}  // namespace woodlouse::document
