// Names beside lice that avoid each other.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/layout.h"
#include "client/drawing/scene.h"
#include "client/ground/map_camera.h"

namespace woodlouse::client {

/// Finds room for texts one row high. What was reserved first stays.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Viewport& viewport) : viewport_(viewport) {}

  /// Keeps a rectangle free of labels.
  void reserve(int column, int row, Size size) { taken_.push_back({column, row, size}); }

  /// The rectangle that two cells span.
  void reserve(Place a, Place b) {
    const Place corner{std::min(a.column, b.column), std::min(a.row, b.row)};
    reserve(corner.column, corner.row, {std::abs(a.column - b.column) + 1, std::abs(a.row - b.row) + 1});
  }

  /// The same for who must be shown: where all are taken the first that is inside.
  std::optional<Place> force(int column, int row, int width, Size reach) {
    if (const auto free = place(column, row, width, reach)) return free;
    std::vector<Viewport> taken = std::move(taken_);
    taken_.clear();
    const auto any = place(column, row, width, reach);
    taken_.insert(taken_.end(), taken.begin(), taken.end());
    return any;
  }

  /// A place for `width` columns near a louse that covers `reach` cells each way around (column, row): above,
  /// below, right, left; none when all are taken or outside. The place is reserved.
  std::optional<Place> place(int column, int row, int width, Size reach) {
    const std::array<Place, 4> choices = {{{column - width / 2, row - reach.rows - 1},
                                           {column - width / 2, row + reach.rows + 1},
                                           {column + reach.columns + 2, row},
                                           {column - reach.columns - 1 - width, row}}};
    for (const Place& choice : choices) {
      if (!viewport_.holds(choice.column, choice.row) ||
          !viewport_.holds(choice.column + width - 1, choice.row))
        continue;
      if (is_taken(choice, width)) continue;
      reserve(choice.column - 1, choice.row, {width + 2, 1});
      return choice;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_taken(const Place& p, int width) const {
    for (const Viewport& t : taken_)
      if (p.row >= t.row && p.row < t.row + t.size.rows && p.column < t.column + t.size.columns &&
          t.column < p.column + width)
        return true;
    return false;
  }

  Viewport viewport_;
  std::vector<Viewport> taken_;
};

/// Writes a louse's name over the picture near (column, row) of the viewport, where there is room.
void draw_label(const LouseMark& louse, const Badge& badge, int column, int row, Size reach, const Look& look,
                const Viewport& viewport, LabelPlacer& labels, CellBuffer& cells);

/// Where yours would be outside the picture, a letter at its edge shows the way; inside nothing happens.
void mark_outside(const Badge& badge, Place at, const Viewport& viewport, CellBuffer& cells);

/// The name as it may be shown: printable, `you` for your own, bots marked with a star, at most `width`
/// columns.
std::u32string shown_name(const std::string& name, LouseKind kind, bool is_you, GlyphSet glyphs, int width);

}  // namespace woodlouse::client
