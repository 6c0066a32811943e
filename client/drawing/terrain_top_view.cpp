#include "client/drawing/terrain_top_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "client/drawing/palette.h"
#include "client/drawing/pixels.h"

namespace woodlouse::client {

double contour_shade(double z, double z_right, double z_below, double interval) {
  constexpr double kDarker = 0.68;
  constexpr double kPixelsApart = 3.0;
  const double rise = std::hypot(z_right - z, z_below - z);
  if (rise < kLeastRise * interval) return 1.0;
  constexpr double kLonely = 14.0;            // pixels between lines beyond which a line half-way helps
  const double first = kOffRound * interval;  // the sparser lines are some of the denser ones
  while (rise * kPixelsApart > interval) interval *= 2.0;
  const auto crosses = [&](double step) {
    const auto number = [&](double height) { return std::floor((height - first) / step); };
    return number(z) != number(z_right) || number(z) != number(z_below);
  };
  if (crosses(interval)) return kDarker;
  if (rise * kLonely >= interval || !crosses(interval / 2.0)) return 1.0;
  // Fades in with the distance: a line that began at its full strength would look broken off.
  return 1.0 - (1.0 - kDarker) * std::min(1.0, 0.35 + 0.65 * (interval / (rise * kLonely) - 1.0));
}

std::vector<Cell> top_layer(const Relief& relief, const MapCamera& camera, Size size, ColorMode mode,
                            Paint paint) {
  const double pixel = camera.column;  // a pixel is square: half a row high
  const double interval = relief.contour_interval(2.5 * pixel);
  // Walls are drawn around the same: a middle that is on the edge but for rounding is ground.
  const CellRange ground = camera.cells_of(relief.terrain().domain(), 2.0);
  std::vector<Color> pixels;
  pixels.reserve(static_cast<std::size_t>(size.columns * size.rows * 2));
  for (int y = 0; y < 2 * size.rows; ++y) {
    for (int x = 0; x < size.columns; ++x) {
      const core::Vec2 p = camera.world(x + 0.5, (y + 0.5) / 2.0);
      if (!ground.holds({x, y})) {
        pixels.push_back(sky_color(1.0, mode));
        continue;
      }
      const terrain::SurfaceSample s = relief.sample(p);
      if (paint == Paint::kSteepness) {
        pixels.push_back(slope_color(std::hypot(s.zx, s.zy) / (1.15 * relief.steep()), mode));
        continue;
      }
      const double shade = contour_shade(s.z, relief.sample(p + core::Vec2{pixel, 0.0}).z,
                                         relief.sample(p - core::Vec2{0.0, pixel}).z, interval);
      pixels.push_back(
          terrain_color(relief.tone(s.z), relief.brightness(p, s) * relief.tile_shade(p) * shade, mode));
    }
  }
  return cells_of_pixels(pixels, size);
}

}  // namespace woodlouse::client
