// Where a mode's marks go in a picture, whichever camera looks: dots on the ground and characters over them.
// A dot is a half-block pixel where the terrain is painted in those, else a cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"
#include "client/drawing/layout.h"
#include "client/drawing/terrain_oblique_view.h"
#include "client/ground/map_camera.h"
#include "shared/core/vec2.h"

namespace woodlouse::client {

/// What a dot or a character is drawn with.
struct Ink {
  Rgb color;
  char32_t glyph = U'.';  ///< where a dot is a cell
  double strength = 1.0;  ///< 0..1 of what lies below; where a dot is a cell everything below 0.7 is plain
  Attributes attributes = 0;  ///< of a cell
  /// Where dots are pixels:
  bool is_set_off = false;  ///< the colour is a pale one, and dark on bright ground (set_off() in palette.h)
  std::optional<Rgb> between{};  ///< of the dots that a dashed line leaves out, laid on as strongly
};

class GroundCanvas {
 public:
  /// A place in dots from the viewport's corner.
  struct Spot {
    double x = 0.0;
    double y = 0.0;
    bool is_hidden = false;  ///< behind a hill
  };
  using Projector = std::function<std::optional<Spot>(core::Vec2 place, double height)>;

  /// From above.
  GroundCanvas(const MapCamera& camera, const Look& look, const Viewport& viewport, CellBuffer& cells);
  /// From a height. All but the look outlive the canvas.
  GroundCanvas(const Relief& relief, const ObliqueCamera& camera, const ObliqueLayer& layer, const Look& look,
               const Viewport& viewport, CellBuffer& cells);

  [[nodiscard]] bool has_pixels() const { return has_pixels_; }
  /// Whether height is seen.
  [[nodiscard]] bool has_height() const { return has_height_; }
  [[nodiscard]] const Viewport& viewport() const { return viewport_; }
  [[nodiscard]] const Look& look() const { return look_; }
  [[nodiscard]] int dots_per_row() const { return has_pixels_ ? 2 : 1; }

  /// Where a place `height` [m] over the ground is seen; empty behind the camera, and nowhere.
  [[nodiscard]] std::optional<Spot> spot(core::Vec2 place, double height = 0.0) const {
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) return std::nullopt;
    const auto seen = projector_(place, height);
    // Further off there is nothing to be pointed at, nor a whole number of dots.
    constexpr double kFarthest = 1e9;
    const bool is_near = seen && std::abs(seen->x) < kFarthest && std::abs(seen->y) < kFarthest;
    return is_near ? seen : std::nullopt;
  }
  void dot(int x, int y, const Ink& ink);
  /// Nothing is written over this cell any more, nor drawn where dots are cells.
  void keep(int column, int row) { kept_.emplace_back(column, row); }
  [[nodiscard]] bool is_kept(int column, int row) const {
    return std::find(kept_.begin(), kept_.end(), std::pair(column, row)) != kept_.end();
  }
  /// Takes away the character that a cell of a picture of pixels shows.
  void uncover(int column, int row);
  /// A straight line over the ground; of `dash` dots every second ones are left out, or `between` (0: none).
  void line(core::Vec2 from, core::Vec2 to, const Ink& ink, int dash);
  /// The outline of an ellipse on the ground, `axis` its half axis along the unit vector `along`.
  void ellipse(core::Vec2 middle, core::Vec2 along, double axis, double across, const Ink& ink, int dash);

  /// A circle's inside, laid on once; only where dots are pixels: characters would be buried.
  void disc(core::Vec2 middle, double radius, const Ink& ink);

  /// Nothing is written in these cells yet. What lies outside is free.
  [[nodiscard]] bool is_free(int column, int row, int columns) const;
  /// Writes over the picture, whole or not at all: never outside, nor over other characters of a picture of
  /// pixels. (column, row) from the viewport's corner.
  bool write(int column, int row, std::u32string_view text, Rgb color, Attributes attributes = kBold);

 private:
  [[nodiscard]] Style style_of(const Ink& ink) const;
  /// The count-th dot of a line.
  void dot_of_line(int x, int y, const Ink& ink, int dash, int count);

  Look look_;
  Viewport viewport_;
  CellBuffer& cells_;
  bool has_pixels_;
  bool has_height_;
  Projector projector_;
  std::vector<std::pair<int, int>> kept_;
};

}  // namespace woodlouse::client
