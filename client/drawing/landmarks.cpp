#include "client/drawing/landmarks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "client/drawing/pixels.h"

namespace woodlouse::client {
namespace {

constexpr Rgb kWall{164, 170, 188};
constexpr Rgb kSeam{96, 200, 208};
constexpr Rgb kSun{255, 232, 150};
constexpr Rgb kNight{10, 12, 32};
constexpr int kDash = 3;  ///< pixels of a seam's dashes, and between them

/// The cells of a layer as pixels, which are mixed with what is painted over them.
class LayerPixels {
 public:
  LayerPixels(Size size, std::vector<Cell>& cells) : size_(size), cells_(cells) {
    assert(cells.size() == static_cast<std::size_t>(size.columns) * static_cast<std::size_t>(size.rows));
  }

  /// share: 0 leaves the pixel as it is, 1 paints it over. Outside nothing happens.
  void mix_in(int x, int y, Rgb color, double share) {
    if (x < 0 || y < 0 || x >= size_.columns || y >= 2 * size_.rows) return;
    Style& style = cells_[static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(size_.columns) +
                          static_cast<std::size_t>(x)]
                       .style;
    Color& pixel = y % 2 == 0 ? style.foreground : style.background;
    pixel = Color::of(mix(rgb_of(pixel), color, share));
  }

  /// Darkens what `is_ground(x, y)`, and paints a sun of this radius with its glow around (x, y) [pixels].
  template <typename IsGround>
  void sun(double x, double y, double radius, const IsGround& is_ground) {
    assert(radius > 0.0);
    const double glow = 0.45 * std::min(size_.columns, 2 * size_.rows) + radius;
    for (int j = 0; j < 2 * size_.rows; ++j) {
      for (int i = 0; i < size_.columns; ++i) {
        const double off = std::hypot(i + 0.5 - x, j + 0.5 - y) - radius;
        if (is_ground(i, j)) {
          mix_in(i, j, kNight, 0.86);
          const double near = std::max(0.0, 1.0 - std::max(0.0, off) / glow);
          mix_in(i, j, {214, 120, 60}, 0.6 * near * near * near);
        }
        if (off < 0.0) mix_in(i, j, off < -0.5 * radius ? Rgb{255, 252, 232} : kSun, 1.0);
      }
    }
  }

 private:
  Size size_;
  std::vector<Cell>& cells_;
};

/// How large a sun is drawn [pixels], `metres` to a pixel.
double sun_radius(const Landmarks& landmarks, double metres) {
  return std::max(1.7, landmarks.core_radius / metres);
}

char32_t edge_glyph(state::Edges edges) {
  return edges == state::Edges::kWalls ? U'#' : edges == state::Edges::kWrap ? U':' : U'.';
}

/// Calls paint(place) for the ring of places around a range.
template <typename Paint>
void for_ring(const CellRange& range, const Paint& paint) {
  for (int column = range.first.column - 1; column <= range.last.column + 1; ++column) {
    paint(Place{column, range.first.row - 1});
    paint(Place{column, range.last.row + 1});
  }
  for (int row = range.first.row; row <= range.last.row; ++row) {
    paint(Place{range.first.column - 1, row});
    paint(Place{range.last.column + 1, row});
  }
}

}  // namespace

void mark_in_characters(const Landmarks& landmarks, const terrain::Rectangle& domain, const MapCamera& camera,
                        Size size, const Look& look, std::vector<Cell>& cells) {
  const bool has_color = look.color != ColorMode::kMono && look.color != ColorMode::k16;
  const auto put = [&](Place place, char32_t glyph, Rgb color, Attributes attributes) {
    if (place.column < 0 || place.row < 0 || place.column >= size.columns || place.row >= size.rows) return;
    Style style{{}, {}, attributes};
    if (has_color) style.foreground = Color::of(color);
    cells[static_cast<std::size_t>(place.row) * static_cast<std::size_t>(size.columns) +
          static_cast<std::size_t>(place.column)] = {glyph, style};
  };
  const char32_t glyph = edge_glyph(landmarks.edges);
  for_ring(camera.cells_of(domain), [&](Place place) {
    put(place, glyph, landmarks.edges == state::Edges::kWrap ? kSeam : scaled(kWall, 0.8), kPlain);
  });
  if (landmarks.core_radius <= 0.0) return;
  const Place middle = camera.cell_of({0.0, 0.0}, domain);
  put({middle.column - 1, middle.row}, U'(', kSun, kBold);
  put(middle, U'*', kSun, kBold);
  put({middle.column + 1, middle.row}, U')', kSun, kBold);
}

void mark_in_pixels(const Landmarks& landmarks, const terrain::Rectangle& domain, const MapCamera& camera,
                    Size size, std::vector<Cell>& cells) {
  LayerPixels pixels(size, cells);
  const CellRange ground = camera.cells_of(domain, 2.0);
  if (landmarks.core_radius > 0.0)
    pixels.sun(camera.column_of({0.0, 0.0}), 2.0 * camera.row_of({0.0, 0.0}),
               sun_radius(landmarks, camera.column), [&](int x, int y) {
                 return ground.holds({x, y});
               });
  if (landmarks.edges == state::Edges::kOpen) return;
  for_ring(ground, [&](Place place) {
    const bool is_seam = landmarks.edges == state::Edges::kWrap;
    const int along = place.column + place.row + 2 * kDash * 1000;
    if (is_seam && along / kDash % 2 != 0) return;
    pixels.mix_in(place.column, place.row, is_seam ? kSeam : kWall, 0.85);
  });
}

void mark_obliquely(const Landmarks& landmarks, const Relief& relief, const ObliqueCamera& camera,
                    ObliqueLayer& layer) {
  LayerPixels pixels(layer.size, layer.cells);
  const int width = layer.size.columns;
  const int height = 2 * layer.size.rows;
  const auto depth_at = [&](int x, int y) {
    return static_cast<double>(layer.depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                           static_cast<std::size_t>(x)]);
  };
  const auto on_ground = [&](core::Vec2 p, double above) {
    return Vec3{p.x, p.y, relief.sample(p).z * relief.exaggeration() + above};
  };
  if (landmarks.core_radius > 0.0) {
    if (const auto at = camera.project(on_ground({0.0, 0.0}, 0.0)))
      pixels.sun(at->x, at->y, sun_radius(landmarks, camera.metres_per_pixel(at->depth)),
                 [&](int x, int y) { return std::isfinite(depth_at(x, y)); });
  }
  if (landmarks.edges == state::Edges::kOpen) return;
  const terrain::Rectangle& d = relief.terrain().domain();
  const bool is_wall = landmarks.edges == state::Edges::kWalls;
  const double up = is_wall ? 0.022 * std::min(d.x_max - d.x_min, d.y_max - d.y_min) : 0.0;
  // What of each pixel the wall covers, so that none is mixed twice.
  std::vector<float> shares(layer.depth.size(), 0.0f);
  const auto cover = [&](double x, double y, double depth, double share) {
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    if (column < 0 || row < 0 || column >= width || row >= height) return;
    if (depth > depth_at(column, row) + 2.5 * camera.metres_per_pixel(depth)) return;
    float& least = shares[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(column)];
    least = std::max(least, static_cast<float>(share));
  };
  const std::array<core::Vec2, 4> corners = {
      {{d.x_min, d.y_min}, {d.x_max, d.y_min}, {d.x_max, d.y_max}, {d.x_min, d.y_max}}};
  for (std::size_t side = 0; side < 4; ++side) {
    const core::Vec2 from = corners[side];
    const core::Vec2 to = corners[(side + 1) % 4];
    const auto a = camera.project(on_ground(from, 0.0));
    const auto b = camera.project(on_ground(to, 0.0));
    if (!a || !b) continue;
    const int steps = std::clamp(static_cast<int>(3.0 * std::hypot(b->x - a->x, b->y - a->y)), 8, 20000);
    for (int i = 0; i <= steps; ++i) {
      const core::Vec2 p = from + (static_cast<double>(i) / steps) * (to - from);
      const auto foot = camera.project(on_ground(p, 0.0));
      const auto head = camera.project(on_ground(p, up));
      if (!foot || !head) continue;
      if (!is_wall && static_cast<int>(foot->x + foot->y + 6000.0) / kDash % 2 != 0) continue;
      for_line(foot->x, foot->y, head->x, head->y,
               [&](int x, int y, double) { cover(x, y, foot->depth, 0.45); });
      cover(head->x, head->y, foot->depth, 0.85);
    }
  }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float share =
          shares[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
      if (share > 0.0f) pixels.mix_in(x, y, is_wall ? kWall : kSeam, static_cast<double>(share));
    }
}

}  // namespace woodlouse::client
