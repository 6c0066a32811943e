// Lanes of lice that slide along a wall, one each (physics/walls.h); corners are the scalar step's. Under the
// rules of kernel.h.
#pragma once

#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// The walls that lanes lean on.
template <typename L>
struct LaneWalls {
  typename L::Mask along_y;  ///< the wall is x = const; else y = const
  L side;                    ///< outwards: -1, 1
};

/// What of a vector is across the wall and what along it.
template <typename L>
struct AcrossWall {
  L across, along;

  [[gnu::always_inline]] inline AcrossWall(const LaneWalls<L>& walls, Pair<L> u)
      : across(core::select(walls.along_y, u.x, u.y)), along(core::select(walls.along_y, u.y, u.x)) {}
};

/// Who touches one wall and has no velocity across it; `walls` is of those.
template <typename L>
[[gnu::always_inline]] inline typename L::Mask slides_along_wall(const terrain::Rectangle& domain, Pair<L> x,
                                                                 Pair<L> v, LaneWalls<L>& walls) {
  const auto high_x = x.x >= L(domain.x_max), high_y = x.y >= L(domain.y_max);
  const auto at_x = (x.x <= L(domain.x_min)) | high_x, at_y = (x.y <= L(domain.y_min)) | high_y;
  walls.along_y = at_x;
  walls.side = core::select((at_x & high_x) | (~at_x & high_y), L(1.0), L(-1.0));
  return ((at_x & ~at_y) | (at_y & ~at_x)) & ~(AcrossWall<L>(walls, v).across != L(0.0));
}

/// As wall_load(); a: the acceleration without friction.
template <typename L>
[[gnu::always_inline]] inline L wall_load(const BasicSlopeSample<L>& s, const LaneWalls<L>& walls,
                                          Pair<L> a) {
  const AcrossWall<L> acceleration(walls, a), gradient(walls, {s.zx, s.zy});
  const L w2 = L(1.0) + s.zx * s.zx + s.zy * s.zy;
  const L load = -gradient.across * acceleration.across * w2 / (L(1.0) + gradient.along * gradient.along);
  return core::select(walls.side * acceleration.across > L(0.0), load, L(0.0));
}

/// As supported().
template <typename L>
[[gnu::always_inline]] inline Pair<L> supported(const BasicSlopeSample<L>& s, const LaneWalls<L>& walls,
                                                Pair<L> a) {
  const AcrossWall<L> parts(walls, a), gradient(walls, {s.zx, s.zy});
  const L across = parts.across - parts.across;
  const L along = parts.along + parts.across * (s.zx * s.zy) / (L(1.0) + gradient.along * gradient.along);
  const auto pushes = walls.side * parts.across > L(0.0);
  return {core::select(pushes, core::select(walls.along_y, across, along), a.x),
          core::select(pushes, core::select(walls.along_y, along, across), a.y)};
}

/// As Ground::accelerate() where a wall is touched.
template <typename F, typename Sample, typename L>
[[gnu::always_inline]] inline Pair<L> accelerate_at_wall(const Sample& s, Pair<L> v,
                                                         const BasicDrive<L>& drive,
                                                         const LaneWalls<L>& walls,
                                                         const state::Parameters& p) {
  Pair<L> a = acceleration<WithoutFriction<F>>(s, v, drive, p);
  if constexpr (F::friction) {
    L load = L(p.gravity) + curvature_along(s, v);
    if constexpr (F::central) load = load + (s.zx * drive.pull.x + s.zy * drive.pull.y);
    load = load + wall_load(s, walls, a);
    const L speed2 = squared_length_in_space(s, v);
    const L w2 = L(1.0) + s.zx * s.zx + s.zy * s.zy;
    const auto moves = speed2 > L(kStandstill2);
    const L resistance =
        L(p.friction) * core::magnitude(load) / core::square_root(w2 * core::select(moves, speed2, L(1.0)));
    a = {core::select(moves, a.x - resistance * v.x, a.x), core::select(moves, a.y - resistance * v.y, a.y)};
  }
  return supported(s, walls, a);
}

/// N w, as Ground::load(); walls: null where none is touched.
template <typename F, typename Sample, typename L>
[[gnu::always_inline]] inline L normal_load(const Sample& s, Pair<L> v, const BasicDrive<L>& drive,
                                            const LaneWalls<L>* walls, const state::Parameters& p) {
  L load = L(p.gravity) + curvature_along(s, v);
  if constexpr (F::central) load = load + (s.zx * drive.pull.x + s.zy * drive.pull.y);
  if (walls == nullptr) return load;
  return load + wall_load(s, *walls, acceleration<WithoutFriction<F>>(s, v, drive, p));
}

}  // namespace woodlouse::physics
