#include "client/drawing/labels.h"

#include <algorithm>
#include <cstddef>

#include "client/drawing/pixels.h"

namespace woodlouse::client {

std::u32string shown_name(const std::string& name, LouseKind kind, bool is_you, GlyphSet glyphs, int width) {
  std::u32string shown = is_you ? U"you" : printable(name, glyphs);
  const std::size_t room =
      static_cast<std::size_t>(std::max(0, width)) - (kind == LouseKind::kBot && width > 0 ? 1 : 0);
  if (shown.size() > room) shown.resize(room);
  if (kind == LouseKind::kBot && width > 0) shown.push_back(U'*');
  return shown;
}

void draw_label(const LouseMark& louse, const Badge& badge, int column, int row, Size reach, const Look& look,
                const Viewport& viewport, LabelPlacer& labels, CellBuffer& cells) {
  constexpr int kLongest = 12;
  const std::u32string name = shown_name(louse.name, louse.kind, louse.is_you, look.glyphs, kLongest);
  const int width = static_cast<int>(name.size());
  const auto place =
      louse.is_you ? labels.force(column, row, width, reach) : labels.place(column, row, width, reach);
  if (!place) return;
  int at = place->column;
  for (const char32_t c : name) put_over(cells, viewport, at++, place->row, c, Color::of(badge.color));
}

void mark_outside(const Badge& badge, Place at, const Viewport& viewport, CellBuffer& cells) {
  if (viewport.holds(at.column, at.row)) return;
  const Place edge{std::clamp(at.column, 0, viewport.size.columns - 1),
                   std::clamp(at.row, 0, viewport.size.rows - 1)};
  cells.put(viewport.column + edge.column, viewport.row + edge.row, static_cast<char32_t>(badge.letter),
            {Color::of({16, 16, 20}), Color::of(badge.color), kBold});
}

}  // namespace woodlouse::client
