#include "client/drawing/terrain_contour_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <utility>

#include "client/drawing/palette.h"

namespace woodlouse::client {
namespace {

/// Heights at half columns and quarter rows (the same length in metres), smoothed: what is smaller than a
/// cell would only break the lines.
class Ground {
 public:
  Ground(const Relief& relief, const MapCamera& camera, Size size)
      : relief_(relief),
        camera_(camera),
        columns_(2 * size.columns + 1 + 2 * kBorder),
        rows_(4 * size.rows + 2 + 2 * kBorder) {
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < columns_; ++i)
        heights_.push_back(relief.extended_height(camera.world((i - kBorder) / 2.0, (j - kBorder) / 4.0)));
    for (int pass = 0; pass < 2; ++pass) {
      smooth(1, columns_, rows_);
      smooth(static_cast<std::size_t>(columns_), rows_, columns_);
    }
  }

  [[nodiscard]] bool holds(double column, double row) const {
    const core::Vec2 p = camera_.world(column, row);
    const terrain::Rectangle& d = relief_.terrain().domain();
    const double rounding = 1e-9 * camera_.row;  // as MapCamera::cells_of has it
    return p.x >= d.x_min - rounding && p.x <= d.x_max + rounding && p.y >= d.y_min - rounding &&
           p.y <= d.y_max + rounding;
  }
  /// Half columns, quarter rows.
  [[nodiscard]] double height(int column2, int row4) const {
    return heights_[index(column2 + kBorder, row4 + kBorder)];
  }
  /// Whether a contour line of this interval lies between two heights.
  [[nodiscard]] static bool crosses(double a, double b, double interval) {
    return contour_number(a, interval) != contour_number(b, interval);
  }

 private:
  static constexpr int kBorder = 2;

  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
  }
  /// 1-2-1 along one direction: `count` heights `stride` apart, in each of `lines` lines.
  void smooth(std::size_t stride, int count, int lines) {
    const std::size_t next_line = stride == 1 ? static_cast<std::size_t>(columns_) : 1;
    for (std::size_t line = 0; line < static_cast<std::size_t>(lines); ++line) {
      double* z = &heights_[line * next_line];
      double before = z[0];
      for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(count); ++k) {
        const double here = z[k * stride];
        z[k * stride] = 0.25 * before + 0.5 * here + 0.25 * z[(k + 1) * stride];
        before = here;
      }
    }
  }

  const Relief& relief_;
  const MapCamera& camera_;
  int columns_;
  int rows_;
  std::vector<double> heights_;
};

/// What a cell knows of the ground under it.
struct Facet {
  double per_column = 0.0;  ///< rise to the next column [m]
  double per_row = 0.0;     ///< rise to the row below [m]
};

Facet facet(const Ground& ground, int column, int row) {
  const int c = 2 * column + 1;
  const int r = 4 * row + 2;
  return {0.5 * (ground.height(c + 2, r) - ground.height(c - 2, r)),
          0.5 * (ground.height(c, r + 4) - ground.height(c, r - 4))};
}

/// The contour's glyph in cell (column, row), or a blank. Glyphs are tested across their own stroke, so that
/// a line is one cell thick.
char contour_glyph(const Ground& ground, const Facet& f, int column, int row, double interval) {
  const int c = 2 * column;
  const int r = 4 * row;
  const auto crosses = [&](int c0, int r0, int c1, int r1) {
    return Ground::crosses(ground.height(c0, r0), ground.height(c1, r1), interval);
  };
  if (std::hypot(f.per_column, f.per_row) < kLeastRise * interval) return ' ';
  constexpr double kFlatter = 0.5;
  if (std::abs(f.per_column) < kFlatter * std::abs(f.per_row)) {
    // '-' stands at half height, '_' at the foot; a line along the top belongs to the cell above.
    if (crosses(c + 1, r + 1, c + 1, r + 3)) return '-';
    return crosses(c + 1, r + 3, c + 1, r + 5) ? '_' : ' ';
  }
  if (std::abs(f.per_row) < kFlatter * std::abs(f.per_column))
    return crosses(c, r + 2, c + 2, r + 2) ? '|' : ' ';
  if (f.per_column * f.per_row > 0.0) return crosses(c, r, c + 2, r + 4) ? '/' : ' ';
  return crosses(c, r + 4, c + 2, r) ? '\\' : ' ';
}

/// Whether lines of a grid cross in a cell.
bool is_crossing(const MapCamera& camera, int column, int row, double tile) {
  const core::Vec2 a = camera.world(column, row);
  const core::Vec2 b = camera.world(column + 1, row + 1);
  return std::floor(a.x / tile) != std::floor(b.x / tile) && std::floor(a.y / tile) != std::floor(b.y / tile);
}

Style contour_style(const Relief& relief, double z, const Look& look) {
  Style style;
  if (look.color == ColorMode::k256 || look.color == ColorMode::kTruecolor)
    style.foreground = contour_color(relief.tone(z));
  return style;
}

Style badge_style(const Badge& badge, const LouseMark& louse, const Look& look) {
  Style style;
  style.attributes = louse.is_you ? kReverse | kBold : kBold;
  if (look.color != ColorMode::kMono) style.foreground = Color::of(badge.color);
  return style;
}

void draw_trail(const LouseMark& louse, const Badge& badge, const Look& look, const MapCamera& camera,
                const Viewport& viewport, CellBuffer& cells) {
  constexpr std::size_t kPoints = 48;  // dots drown the lines sooner than pixels do
  for (std::size_t i = louse.trail.size() - std::min(louse.trail.size(), kPoints); i < louse.trail.size();
       ++i) {
    const int column = static_cast<int>(std::floor(camera.column_of(louse.trail[i])));
    const int row = static_cast<int>(std::floor(camera.row_of(louse.trail[i])));
    if (!viewport.holds(column, row)) continue;
    const bool is_recent = i + kPoints / 2 >= louse.trail.size();
    Style style;
    style.attributes = is_recent ? kBold : kPlain;
    if (look.color != ColorMode::kMono)
      style.foreground = trail_color(badge.color, is_recent ? TrailAge::kRecent : TrailAge::kOld, look.color);
    cells.put(viewport.column + column, viewport.row + row, U'.', style);
  }
}

}  // namespace

std::vector<Cell> contour_layer(const Relief& relief, const MapCamera& camera, Size size, const Look& look) {
  const Ground ground(relief, camera, size);
  const double interval = relief.contour_interval(camera.row * 0.6);
  std::vector<Cell> layer;
  layer.reserve(static_cast<std::size_t>(size.columns * size.rows));
  for (int row = 0; row < size.rows; ++row) {
    for (int column = 0; column < size.columns; ++column) {
      Cell cell;
      if (ground.holds(column + 0.5, row + 0.5)) {
        const Facet f = facet(ground, column, row);
        cell.style = contour_style(relief, ground.height(2 * column + 1, 4 * row + 2), look);
        char glyph = contour_glyph(ground, f, column, row, interval);
        // Lines further apart than this leave the eye nothing to follow.
        constexpr double kLonely = 4.5;
        const double rows_apart = interval / std::max(1e-12, std::hypot(2.0 * f.per_column, f.per_row));
        for (int part = 2; glyph == ' ' && part <= 4 && rows_apart > kLonely * part / 2; part *= 2)
          if (part == 2 || column % 2 == 0) glyph = contour_glyph(ground, f, column, row, interval / part);
        if (relief.is_flat() && is_crossing(camera, column, row, relief.tile())) glyph = '+';
        cell.glyph = static_cast<char32_t>(glyph);
      }
      layer.push_back(cell);
    }
  }
  return layer;
}

std::vector<Cell> slope_character_layer(const Relief& relief, const MapCamera& camera, Size size,
                                        const Look& look) {
  constexpr std::string_view kDensity = " .:-=+*#%";
  const Ground ground(relief, camera, size);
  std::vector<Cell> layer;
  layer.reserve(static_cast<std::size_t>(size.columns * size.rows));
  for (int row = 0; row < size.rows; ++row) {
    for (int column = 0; column < size.columns; ++column) {
      Cell cell;
      if (ground.holds(column + 0.5, row + 0.5)) {
        const terrain::SurfaceSample s = relief.sample(camera.world(column + 0.5, row + 0.5));
        const double steepness = std::min(1.0, std::hypot(s.zx, s.zy) / relief.steep());
        const auto index =
            static_cast<std::size_t>(steepness * static_cast<double>(kDensity.size() - 1) + 0.5);
        cell.glyph = static_cast<char32_t>(kDensity[index]);
        if (look.color == ColorMode::k256 || look.color == ColorMode::kTruecolor)
          cell.style.foreground = slope_color(0.25 + 0.6 * steepness, look.color);
      }
      layer.push_back(cell);
    }
  }
  return layer;
}

HeadingGlyph heading_glyph(core::Vec2 heading) {
  constexpr std::array<HeadingGlyph, 8> kCompass = {{{'>', 1, 0},
                                                     {'/', 1, -1},
                                                     {'^', 0, -1},
                                                     {'\\', -1, -1},
                                                     {'<', -1, 0},
                                                     {'/', -1, 1},
                                                     {'v', 0, 1},
                                                     {'\\', 1, 1}}};
  const double eighths = std::atan2(heading.y, heading.x) / (std::numbers::pi / 4.0);
  return kCompass[static_cast<std::size_t>((std::lround(eighths) + 8) % 8)];
}

void draw_lice_as_letters(const Scene& scene, const Badges& badges, const MapCamera& camera,
                          const Viewport& viewport, CellBuffer& cells) {
  const auto place = [&](const LouseMark& louse) {
    return camera.cell_of(louse.position, scene.terrain->domain());
  };
  const auto put = [&](int column, int row, char32_t glyph, const Style& style) {
    if (viewport.holds(column, row)) cells.put(viewport.column + column, viewport.row + row, glyph, style);
  };
  const auto order = in_drawing_order(scene);
  for (const LouseMark* louse : order) {
    const auto [column, row] = place(*louse);
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) put(column + x, row + y, U' ', {});
  }
  for (const LouseMark* louse : order)
    draw_trail(*louse, badges.of(louse->id), scene.look, camera, viewport, cells);
  for (const LouseMark* each : order) {
    const LouseMark& louse = *each;
    const auto [column, row] = place(louse);
    const Badge badge = badges.of(louse.id);
    const HeadingGlyph heading = heading_glyph(louse.heading);
    const Style style = badge_style(badge, louse, scene.look);
    Style plain = style;
    plain.attributes = kBold;
    put(column + heading.columns, row + heading.rows, static_cast<char32_t>(heading.glyph), plain);
    put(column, row, static_cast<char32_t>(badge.letter), style);
    if (louse.above > 0.0) {  // its shadow, as far to the south-east as it flies high
      const core::Vec2 under = louse.position + louse.above * kShadowWay;
      const Place shade = camera.cell_of(under, scene.terrain->domain());
      if (shade != Place{column, row}) put(shade.column, shade.row, U',', plain);
    }
    if (!louse.is_you || viewport.holds(column, row)) continue;
    const Place edge{std::clamp(column, 0, viewport.size.columns - 1),
                     std::clamp(row, 0, viewport.size.rows - 1)};
    put(edge.column, edge.row, static_cast<char32_t>(badge.letter), style);
  }
}

}  // namespace woodlouse::client
