#include "client/drawing/oblique_painter.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "client/drawing/pixels.h"

namespace woodlouse::client {
namespace {

constexpr Rgb kRim{10, 10, 16};

/// Three brightnesses only: a moving louse then changes fewer cells.
Rgb skin(const LouseShape::Hit& hit, const Badge& badge) {
  constexpr Vec3 kToSun{-0.55, 0.2, 0.81};
  const double lit = dot(hit.normal, kToSun);
  const double brightness = lit > 0.55 ? 1.0 : lit > 0.1 ? 0.78 : 0.56;
  return scaled(body_color(badge, hit.along), brightness);
}

}  // namespace

ObliquePainter::ObliquePainter(const Relief& relief, const ObliqueCamera& camera, const ObliqueLayer& layer,
                               const Viewport& viewport, CellBuffer& cells)
    : relief_(relief),
      camera_(camera),
      viewport_(viewport),
      cells_(cells),
      width_(layer.size.columns),
      height_(2 * layer.size.rows),
      ground_(layer.depth),
      bodies_(layer.depth.size(), std::numeric_limits<float>::infinity()) {
  assert(layer.size == viewport.size);
}

void ObliquePainter::mix_in(int x, int y, Rgb color, double share) {
  const Cell& cell = cells_.at(viewport_.column + x, viewport_.row + y / 2);
  const Color there = y % 2 == 0 ? cell.style.foreground : cell.style.background;
  if (cell.glyph == kUpperHalfBlock)
    put_pixel(cells_, viewport_, x, y, Color::of(mix(rgb_of(there), color, share)));
}

void ObliquePainter::line(Vec3 from, Vec3 to, Color color) {
  const auto a = camera_.project(from);
  const auto b = camera_.project(to);
  if (!a || !b) return;
  const double tolerance = 2.0 * camera_.metres_per_pixel(a->depth);
  for_line(a->x, a->y, b->x, b->y, [&](int x, int y, double t) {
    if (contains(x, y) && a->depth + (b->depth - a->depth) * t < ground_[index(x, y)] + tolerance)
      put_pixel(cells_, viewport_, x, y, color);
  });
}

void ObliquePainter::shadow(core::Vec2 under, double half_length) {
  const Vec3 middle = over_ground(under);
  const auto at = camera_.project(middle);
  if (!at) return;
  const double reach = half_length / camera_.metres_per_pixel(at->depth);
  // As flat as a disc on level ground is seen.
  const double flat = std::max(0.35, -camera_.forward().z);
  for (int y = static_cast<int>(std::floor(at->y - reach)); y <= static_cast<int>(at->y + reach); ++y) {
    for (int x = static_cast<int>(std::floor(at->x - reach)); x <= static_cast<int>(at->x + reach); ++x) {
      const double off = std::hypot(x + 0.5 - at->x, (y + 0.5 - at->y) / flat);
      if (!contains(x, y) || off > reach || at->depth > ground_[index(x, y)] + half_length) continue;
      if (std::isfinite(ground_[index(x, y)])) mix_in(x, y, kRim, 0.55);
    }
  }
}

void ObliquePainter::solid(const LouseShape& shape, double half_length, const Badge& badge, Owner owner) {
  const double favour = owner == Owner::kYou ? 2.0 * half_length : 0.0;
  const auto at = camera_.project(shape.centre());
  if (!at) return;
  const double reach = half_length / camera_.metres_per_pixel(at->depth) + 1.0;
  const int left = static_cast<int>(std::floor(at->x - reach)), right = static_cast<int>(at->x + reach);
  const int upper = static_cast<int>(std::floor(at->y - reach)), lower = static_cast<int>(at->y + reach);
  const auto width = static_cast<std::size_t>(right - left + 3);  // and a rim around
  std::vector<bool> covered(width * static_cast<std::size_t>(lower - upper + 3));
  const auto in_box = [&](int x, int y) {
    return static_cast<std::size_t>(y - upper + 1) * width + static_cast<std::size_t>(x - left + 1);
  };
  for (int y = upper; y <= lower; ++y) {
    for (int x = left; x <= right; ++x) {
      if (!contains(x, y)) continue;
      const auto hit = shape.hit(camera_.eye(), camera_.ray(x + 0.5, y + 0.5));
      if (!hit) continue;
      if (hit->way > ground_[index(x, y)] + 0.5 * half_length) {
        if (owner == Owner::kYou && (x + y) % 2 == 0) mix_in(x, y, badge.color, 0.75);
        continue;
      }
      if (hit->way - favour > bodies_[index(x, y)]) continue;
      bodies_[index(x, y)] = static_cast<float>(hit->way - favour);
      covered[in_box(x, y)] = true;
      put_pixel(cells_, viewport_, x, y, Color::of(skin(*hit, badge)));
    }
  }
  for (int y = upper - 1; y <= lower + 1; ++y) {
    for (int x = left - 1; x <= right + 1; ++x) {
      if (!contains(x, y) || covered[in_box(x, y)]) continue;
      const auto is_body = [&](int i, int j) {
        return i >= left && i <= right && j >= upper && j <= lower && covered[in_box(i, j)];
      };
      if (!is_body(x - 1, y) && !is_body(x + 1, y) && !is_body(x, y - 1) && !is_body(x, y + 1)) continue;
      if (at->depth - favour < bodies_[index(x, y)] && at->depth < ground_[index(x, y)] + half_length)
        mix_in(x, y, kRim, 0.6);
    }
  }
}

}  // namespace woodlouse::client
