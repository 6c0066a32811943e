// The vertical walls at the domain's edge.
//
// A wall's reaction lies in the tangent plane: at a wall x = const it is along (1, -zx zy / (1 + zy^2)), the
// tangent whose dot product in space with the wall's own direction is zero; likewise at y = const. So an
// impact with restitution e changes v by -(1 + e) vx (1, -zx zy / (1 + zy^2)) and takes energy or leaves it,
// never gives; a plain vx -> -vx makes energy on a slope. Pressed against a wall with no normal velocity, a
// louse slides: the same reaction cancels the outward acceleration. A corner is both walls.
//
// A wall has no friction, but it carries: its reaction F, over the map along its normal, adds G.F to N w
// (surface_motion.h), and the ground's friction is of what is left. It cancels a, the acceleration without
// friction (which has no part along the normal of a wall that the louse slides along): F - G (G.F) / w^2 = -a
// in the walls' components, which at x = const gives G.F = -zx ax w^2 / (1 + zy^2), in a corner -w^2 G.a. A
// louse pressed downhill against a wall weighs less on the ground, one pressed uphill by a thrust more.
#pragma once

#include "shared/core/vec2.h"
#include "shared/terrain/surface.h"

namespace woodlouse::physics {

/// Which walls a point touches: -1 the low wall, +1 the high wall, 0 none, per axis.
struct Contact {
  int x = 0;
  int y = 0;
  [[nodiscard]] constexpr bool any() const { return x != 0 || y != 0; }
};

inline Contact touching(const terrain::Rectangle& domain, core::Vec2 p) {
  return {p.x <= domain.x_min ? -1 : (p.x >= domain.x_max ? 1 : 0),
          p.y <= domain.y_min ? -1 : (p.y >= domain.y_max ? 1 : 0)};
}

constexpr bool outward(int side, double component) {
  return (side > 0 && component > 0.0) || (side < 0 && component < 0.0);
}

/// u less `factor` times its x component's reaction: factor 1 cancels the component, 1 + e reflects it.
inline core::Vec2 react_x(const terrain::SlopeSample& s, core::Vec2 u, double factor) {
  const double impulse = factor * u.x;
  return {u.x - impulse, u.y + impulse * (s.zx * s.zy) / (1.0 + s.zy * s.zy)};
}

inline core::Vec2 react_y(const terrain::SlopeSample& s, core::Vec2 u, double factor) {
  const double impulse = factor * u.y;
  return {u.x + impulse * (s.zx * s.zy) / (1.0 + s.zx * s.zx), u.y - impulse};
}

/// Those of the touched walls that push back against `a`: each pushes inwards or not at all.
inline Contact supporting(const terrain::SlopeSample& s, Contact contact, core::Vec2 a) {
  const bool x = outward(contact.x, a.x);
  const bool y = outward(contact.y, a.y);
  if (x && !outward(contact.y, react_x(s, a, 1.0).y)) return {contact.x, 0};
  if (y && !outward(contact.x, react_y(s, a, 1.0).x)) return {0, contact.y};
  return x || y ? contact : Contact{};
}

/// The acceleration that the touched walls leave of `a`.
inline core::Vec2 supported(const terrain::SlopeSample& s, Contact contact, core::Vec2 a) {
  const Contact walls = supporting(s, contact, a);
  if (!walls.any()) return a;
  if (walls.y == 0) return react_x(s, a, 1.0);
  if (walls.x == 0) return react_y(s, a, 1.0);
  return {0.0, 0.0};
}

/// What the touched walls add to N w where a is the acceleration without friction [m/s^2].
inline double wall_load(const terrain::SlopeSample& s, Contact contact, core::Vec2 a) {
  const Contact walls = supporting(s, contact, a);
  if (!walls.any()) return 0.0;
  const double w2 = 1.0 + s.zx * s.zx + s.zy * s.zy;
  if (walls.y == 0) return -s.zx * a.x * w2 / (1.0 + s.zy * s.zy);
  if (walls.x == 0) return -s.zy * a.y * w2 / (1.0 + s.zx * s.zx);
  return -w2 * (s.zx * a.x + s.zy * a.y);
}

/// The velocity after the impacts on the touched walls; `restitution` 0 leaves no outward velocity.
inline core::Vec2 bounced(const terrain::SlopeSample& s, Contact contact, core::Vec2 v, double restitution) {
  constexpr int kCornerImpacts = 8;  // between the two walls of one corner
  for (int i = 0; i < kCornerImpacts; ++i) {
    if (outward(contact.x, v.x)) {
      v = react_x(s, v, 1.0 + restitution);
    } else if (outward(contact.y, v.y)) {
      v = react_y(s, v, 1.0 + restitution);
    } else {
      return v;
    }
  }
  return outward(contact.x, v.x) || outward(contact.y, v.y) ? core::Vec2{0.0, 0.0} : v;
}

}  // namespace woodlouse::physics
