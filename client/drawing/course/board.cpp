#include "client/drawing/course/board.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "client/drawing/formatted.h"
#include "client/drawing/labels.h"
#include "client/drawing/pixels.h"

namespace woodlouse::client {
namespace {

constexpr Rgb kGood{104, 232, 150};
constexpr Rgb kBad{255, 118, 92};
constexpr int kLineMargins = 2;  ///< columns left and right of a line

Rgb tone_color(Tone tone, const Look& look) {
  switch (tone) {
    case Tone::kGood:
      return kGood;
    case Tone::kBad:
      return kBad;
    case Tone::kGoal:
      return goal_color(look);
    case Tone::kDim:
      return {150, 156, 172};
    case Tone::kUsual:
    case Tone::kStrong:
      break;
  }
  return {255, 255, 255};
}

/// A figure of 3 x 5, a row a number, the leftmost dot its highest bit.
struct Figure {
  char character;
  std::array<std::uint8_t, 5> rows;
};
constexpr std::array<Figure, 16> kFigures = {{{'0', {7, 5, 5, 5, 7}},
                                              {'1', {2, 6, 2, 2, 7}},
                                              {'2', {7, 1, 7, 4, 7}},
                                              {'3', {7, 1, 7, 1, 7}},
                                              {'4', {5, 5, 7, 1, 1}},
                                              {'5', {7, 4, 7, 1, 7}},
                                              {'6', {7, 4, 7, 5, 7}},
                                              {'7', {7, 1, 2, 2, 2}},
                                              {'8', {7, 5, 7, 5, 7}},
                                              {'9', {7, 5, 7, 1, 7}},
                                              {'+', {0, 2, 7, 2, 0}},
                                              {'-', {0, 0, 7, 0, 0}},
                                              {'.', {0, 0, 0, 0, 2}},
                                              {':', {0, 2, 0, 2, 0}},
                                              {'x', {0, 5, 2, 5, 0}},
                                              {'#', {5, 7, 5, 7, 5}}}};
constexpr int kFigureWidth = 3, kFigureHeight = 5, kAdvance = 4;

/// Calls dot(x, y) for each dot of the text.
template <typename Dot>
void for_dots(std::string_view text, const Dot& dot) {
  int left = 0;
  for (const char c : text) {
    const auto figure =
        std::find_if(kFigures.begin(), kFigures.end(), [c](const Figure& f) { return f.character == c; });
    for (int y = 0; figure != kFigures.end() && y < kFigureHeight; ++y)
      for (int x = 0; x < kFigureWidth; ++x)
        if ((figure->rows[static_cast<std::size_t>(y)] >> (kFigureWidth - 1 - x) & 1) != 0) dot(left + x, y);
    left += c == '.' || c == ':' ? kAdvance - 1 : kAdvance;
  }
}

int width_of(std::string_view text) {
  int width = -1;
  for (const char c : text) width += c == '.' || c == ':' ? kAdvance - 1 : kAdvance;
  return std::max(0, width);
}

/// A pixel whatever the cell shows: big figures stand over all.
void force_pixel(CellBuffer& cells, const Viewport& map, int x, int y, Rgb color) {
  if (y < 0 || !map.holds(x, y / 2) || !cells.contains(map.column + x, map.row + y / 2)) return;
  Cell& cell = cells.at(map.column + x, map.row + y / 2);
  if (cell.glyph != kUpperHalfBlock)
    cell = {kUpperHalfBlock, {cell.style.background, cell.style.background, kPlain}};
  put_pixel(cells, map, x, y, Color::of(color));
}

/// Where `rows` of figures stand: at the top, or at the bottom, where your louse would be under them, or else
/// the next gate, which at the bottom is not.
int row_of_splash(const Viewport& map, int left, int columns, int rows, const InSight& in_sight) {
  constexpr int kTop = 1;
  constexpr Size kLouse{4, 2};  // as far as one reaches from its place
  const auto& yours = in_sight.yours;
  const bool is_beside =
      !yours || yours->column <= left - kLouse.columns || yours->column >= left + columns + kLouse.columns;
  const int bottom = std::max(kTop, map.size.rows - rows - 1);
  const auto hides_you = [&](int top) {
    return !is_beside && yours->row > top - kLouse.rows && yours->row < top + rows + kLouse.rows;
  };
  const auto hides_gate = [&](int top) {
    return std::any_of(in_sight.gate.begin(), in_sight.gate.end(), [&](const Viewport& g) {
      return g.column < left + columns && left < g.column + g.size.columns && g.row < top + rows &&
             top < g.row + g.size.rows;
    });
  };
  if (hides_you(kTop)) return bottom;
  return hides_gate(kTop) && !hides_gate(bottom) && !hides_you(bottom) ? bottom : kTop;
}

void draw_splash(const Splash& splash, const Look& look, const Viewport& map, const InSight& in_sight,
                 CellBuffer& cells) {
  const int width = width_of(splash.text);
  if (width == 0) return;
  if (!paints_pixels(look)) {
    const int left = (map.size.columns - width) / 2;
    const int row = row_of_splash(map, left, width, kFigureHeight, in_sight);
    const Style style = tone_style(splash.tone, {}, look);
    for (int y = -1; y <= kFigureHeight; ++y)
      for (int x = -1; x <= width; ++x)
        if (map.holds(left + x, row + y)) cells.put(map.column + left + x, map.row + row + y, U' ', {});
    for_dots(splash.text, [&](int x, int y) {
      if (map.holds(left + x, row + y)) cells.put(map.column + left + x, map.row + row + y, U'#', style);
    });
    return;
  }
  const int scale = map.size.columns >= 2 * width + 12 && map.size.rows >= 20 ? 2 : 1;
  const int left = (map.size.columns - scale * width) / 2;
  const int row = row_of_splash(map, left, scale * width, (scale * kFigureHeight + 1) / 2, in_sight);
  const auto paint = [&](int grow, Rgb color) {
    for_dots(splash.text, [&](int x, int y) {
      for (int dy = -grow; dy < scale + grow; ++dy)
        for (int dx = -grow; dx < scale + grow; ++dx)
          force_pixel(cells, map, left + scale * x + dx, 2 * row + scale * y + dy, color);
    });
  };
  paint(1, {14, 15, 20});
  paint(0, tone_color(splash.tone, look));
}

int width_of(const GoalLine& line, const Look& look) {
  int width = 0;
  for (const GoalSpan& span : line) width += static_cast<int>(printable(span.text, look.glyphs).size());
  return width;
}

/// The parts that fit whole: first the extras are left out, then what comes last.
GoalLine fitted(GoalLine line, int columns, const Look& look) {
  while (line.size() > 1 && width_of(line, look) > columns) {
    const auto extra =
        std::find_if(line.rbegin(), line.rend(), [](const GoalSpan& span) { return span.is_extra; });
    line.erase(extra == line.rend() ? std::prev(line.end()) : std::prev(extra.base()));
  }
  return line;
}

/// The parts in as many lines as they need.
std::vector<GoalLine> broken(const std::vector<GoalLine>& whole, int columns, const Look& look) {
  std::vector<GoalLine> lines;
  for (const GoalLine& line : whole) {
    lines.emplace_back();
    for (const GoalSpan& span : line) {
      const bool fits = width_of(lines.back(), look) + width_of({span}, look) <= columns;
      if (!fits && !lines.back().empty()) lines.emplace_back();
      lines.back().push_back(span);
    }
  }
  return lines;
}

void draw_lines(const std::vector<GoalLine>& lines, const Look& look, const Viewport& board, const Style& bar,
                CellBuffer& cells) {
  cells.fill(board.column, board.row, board.size, bar);
  const int room = board.size.columns - kLineMargins;
  for (int row = 0; row < std::min(board.size.rows, static_cast<int>(lines.size())); ++row) {
    int at = board.column + 1;
    for (const GoalSpan& span : fitted(lines[static_cast<std::size_t>(row)], room, look)) {
      std::u32string text = printable(span.text, look.glyphs);
      const auto left = static_cast<std::size_t>(std::max(0, board.column + 1 + room - at));
      if (text.size() > left) text.resize(std::min(left, text.rfind(U' ', left)));  // alone, and too long
      at = cells.text(at, board.row + row, text, tone_style(span.tone, bar, look));
    }
  }
}

/// The three steps, second and third beside the first.
void draw_podium(const Scene& scene, const Badges& badges, const Viewport& map, int row, CellBuffer& cells) {
  const auto& steps = scene.course.podium;
  const Styles styles = styles_for(scene.look);
  const int width = std::min(16, (map.size.columns - 2) / 3);
  constexpr std::array kHeights = {4, 3, 2};  // of the steps, the first one's first
  constexpr std::array kPlaces = {1, 0, 2};   // from left to right
  const int foot = row + 2 + kHeights[0];     // where all steps end
  const int left = map.column + (map.size.columns - 3 * width) / 2;
  const bool has_pixels = paints_pixels(scene.look);
  for (std::size_t place = 0; place < std::min(steps.size(), kHeights.size()); ++place) {
    const PodiumStep& step = steps[place];
    const int column = left + kPlaces[place] * width;
    const int top = foot - kHeights[place];
    const auto centred = [&](int y, std::u32string text, const Style& style) {
      if (static_cast<int>(text.size()) > width - 2) text.resize(static_cast<std::size_t>(width - 2));
      cells.text(column + (width - static_cast<int>(text.size())) / 2, map.row + y, text, style);
    };
    const auto ascii = [](std::string_view text) { return std::u32string(text.begin(), text.end()); };
    Style name = step.is_you ? styles.strong : styles.text;
    if (scene.look.color != ColorMode::kMono) name.foreground = Color::of(badges.of(step.id).color);
    cells.fill(column, map.row + top - 2, {width, 2}, styles.text);
    centred(top - 2, shown_name(step.name, LouseKind::kPlayer, step.is_you, scene.look.glyphs, width - 2),
            name);
    centred(top - 1, ascii(step.measure), styles.strong);
    Style block = styles.bar;
    if (has_pixels) block.background = Color::of(scaled(badges.of(step.id).color, 0.35));
    for (int y = top; y < foot; ++y) {
      cells.fill(column, map.row + y, {width, 1}, block);
      if (!has_pixels) {
        cells.put(column, map.row + y, U'|', styles.dim);
        cells.put(column + width - 1, map.row + y, U'|', styles.dim);
      }
    }
    if (!has_pixels)
      for (int x = 0; x < width; ++x)
        cells.put(column + x, map.row + top, x == 0 || x == width - 1 ? U'+' : U'-', styles.dim);
    Style number = block;
    number.attributes = kBold;
    if (scene.look.color != ColorMode::kMono) number.foreground = Color::of(goal_color(scene.look));
    const int middle = top + (has_pixels ? 0 : 1);
    centred(middle, ascii(std::to_string(place + 1)), number);
    if (!step.medal.empty() && middle + 1 < foot) centred(middle + 1, ascii(step.medal), number);
  }
  if (scene.course.podium_note.empty()) return;
  const std::u32string note = printable(scene.course.podium_note, scene.look.glyphs);
  const int at = map.column + std::max(0, (map.size.columns - static_cast<int>(note.size())) / 2 - 1);
  const int end = cells.text(at + 1, map.row + foot, note, styles.bar, map.size.columns - 2);
  cells.put(at, map.row + foot, U' ', styles.bar);
  cells.put(end, map.row + foot, U' ', styles.bar);
}

}  // namespace

Style tone_style(Tone tone, const Style& base, const Look& look) {
  Style style = base;
  if (tone != Tone::kUsual && tone != Tone::kDim) style.attributes |= kBold;
  if (look.color == ColorMode::kMono || tone == Tone::kUsual || tone == Tone::kStrong) return style;
  style.foreground = Color::of(tone_color(tone, look));
  return style;
}

LineRows line_rows(const Scene& scene, int columns) {
  assert(columns > kLineMargins);
  constexpr int kMostGoal = 3;  // in the smallest terminal most is still the map's
  constexpr int kMostLesson = 4;
  const int goal = static_cast<int>(scene.course.lines.size());
  const int lesson = static_cast<int>(broken(scene.course.lesson, columns - kLineMargins, scene.look).size());
  return {goal == 0 ? 0 : std::clamp(goal, 2, kMostGoal), std::min(lesson, kMostLesson)};
}

void draw_course_board(const Scene& scene, const Badges& badges, const Layout& layout,
                       const InSight& in_sight, CellBuffer& cells) {
  const Styles styles = styles_for(scene.look);
  const Viewport& map = layout.map;
  draw_lines(scene.course.lines, scene.look, layout.goal, styles.bar, cells);
  draw_lines(broken(scene.course.lesson, layout.lesson.size.columns - kLineMargins, scene.look), scene.look,
             layout.lesson, styles.bar, cells);
  constexpr int kPodiumRows = 8;
  if (!scene.course.podium.empty() && kPodiumRows < map.size.rows)
    draw_podium(scene, badges, map, 1, cells);
  else if (scene.course.splash && kFigureHeight + 2 < map.size.rows)
    draw_splash(*scene.course.splash, scene.look, map, in_sight, cells);
}

}  // namespace woodlouse::client
