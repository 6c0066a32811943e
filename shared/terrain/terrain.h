// A terrain: one of the surfaces a map can ask for, behind one type. The equations of motion are compiled for
// each alternative and reached by one visit per tick, not per louse.
#pragma once

#include <variant>

#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/function_surface.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/plane_surface.h"
#include "shared/terrain/shared_surface.h"
#include "shared/terrain/surface.h"
#include "shared/terrain/tiled_bspline.h"

namespace woodlouse::terrain {

/// Immutable after construction; any thread may sample it. (What a big map keeps in memory changes, behind a
/// lock of its own, and never shows in a sample: tile_store.h.)
class Terrain {
 public:
  using Alternatives = std::variant<BicubicSpline, FunctionSurface, TiledGround, PlaneSurface, SharedSurface>;

  explicit Terrain(Alternatives surface);

  [[nodiscard]] const Alternatives& surface() const { return surface_; }
  [[nodiscard]] const Rectangle& domain() const { return domain_; }

  /// z, gradient and Hessian at a point. REQUIRES domain().contains(x, y).
  [[nodiscard]] SurfaceSample sample(double x, double y) const;

 private:
  Alternatives surface_;
  Rectangle domain_;
};

/// The heights of `terrain` at columns x rows equally spaced knots over its whole domain; both >= 2.
HeightGrid sample_grid(const Terrain& terrain, std::size_t columns, std::size_t rows);

}  // namespace woodlouse::terrain
