#include "client/drawing/course/course_marks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "client/drawing/course/course.h"
#include "client/drawing/formatted.h"
#include "client/drawing/palette.h"
#include "client/drawing/terrain_contour_view.h"

namespace woodlouse::client {
namespace {

constexpr double kPost = 1.2;  ///< height of a gate's posts [m]
constexpr double kGhostStrength = 0.4;

using Spot = GroundCanvas::Spot;

std::u32string wide(std::string_view ascii) { return {ascii.begin(), ascii.end()}; }

int whole(double dots) { return static_cast<int>(std::floor(dots)); }

/// Of what is wanted; on the ground its dashes lie between dark ones.
Ink goal_ink(const Look& look, char32_t glyph) {
  return {goal_color(look), glyph, 1.0, kBold, false, kMarkShade};
}

Ink pale_ink(PaleMark mark, const Look& look, char32_t glyph, double strength,
             Attributes attributes = kPlain) {
  return {pale_color(mark, look), glyph, strength, attributes, true};
}

/// A post stands up where height is seen, at least three dots; from above it is a spot. Its foot is dark.
void draw_post(core::Vec2 foot, const Ink& ink, GroundCanvas& canvas) {
  const auto at = canvas.spot(foot);
  if (!at) return;
  const int x = whole(at->x);
  const int y = whole(at->y);
  if (!canvas.has_height()) {
    canvas.dot(x, y, ink);
    if (canvas.has_pixels()) canvas.dot(x, y ^ 1, ink);  // the whole cell
    return;
  }
  if (at->is_hidden) return;
  const auto top = canvas.spot(foot, kPost);
  const int dots = std::max(3, top ? static_cast<int>(std::lround(at->y - top->y)) : 0);
  for (int k = 0; k < dots; ++k) canvas.dot(x, y - k, ink);
  if (ink.between) canvas.dot(x, y + 1, {*ink.between});
}

void draw_gate(const GateMark& gate, GroundCanvas& canvas) {
  const Ink line =
      gate.is_next ? goal_ink(canvas.look(), U':') : pale_ink(PaleMark::kGate, canvas.look(), U'.', 0.5);
  const Ink post = gate.is_next ? goal_ink(canvas.look(), U'#')
                                : pale_ink(PaleMark::kGate, canvas.look(), U'+', 0.75, kBold);
  canvas.line(gate.a, gate.b, line, canvas.has_pixels() ? 2 : 1);
  draw_post(gate.a, post, canvas);
  draw_post(gate.b, post, canvas);
}

/// Around the crumb that is told of: brackets, or a circle of dots.
void draw_target(int x, int y, GroundCanvas& canvas) {
  if (!canvas.has_pixels()) {
    canvas.dot(x - 1, y, goal_ink(canvas.look(), U'['));
    canvas.dot(x + 1, y, goal_ink(canvas.look(), U']'));
    return;
  }
  for (const int side : {-1, 1})
    for (const auto& [dx, dy] : {std::pair{5, 1}, std::pair{1, 5}, std::pair{5, -1}, std::pair{-1, 5},
                                 std::pair{3, 3}, std::pair{3, -3}})  // in halves from its middle
      canvas.dot(x + (1 + side * dx) / 2, y - (1 + side * dy) / 2, goal_ink(canvas.look(), U'o'));
}

/// Pale, over a shade; a dear one is larger.
void draw_crumb(const CrumbMark& crumb, GroundCanvas& canvas) {
  const auto at = canvas.spot(crumb.position);
  if (!at || at->is_hidden) return;
  const bool is_dear = crumb.value > 1;
  const Ink ink = is_dear ? goal_ink(canvas.look(), U'*')
                          : Ink{pale_color(PaleMark::kCrumb, canvas.look()), U'o', 1.0, kBold};
  const int x = whole(at->x);
  const int y = whole(at->y);
  if (crumb.is_wanted) draw_target(x, y, canvas);
  canvas.dot(x, y, ink);
  if (!canvas.has_pixels()) return;
  canvas.dot(x, y + 1, {kMarkShade});
  if (!is_dear) return;
  for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, -1}, std::pair{1, -1}})
    canvas.dot(x + dx, y + dy, ink);
  canvas.dot(x + 1, y + 1, {kMarkShade});
}

/// What a ring's line is drawn with, and how it is dashed.
std::pair<Ink, int> line_of(const RingMark& ring, const Badges& badges, const Look& look) {
  switch (ring.state) {
    case RingMark::State::kHeld: {
      const Badge holder = badges.of(ring.holder);
      return {{holder.color, holder.letter == '@' ? U'%' : U'#', 1.0, kBold}, 0};
    }
    case RingMark::State::kContested:
      return {goal_ink(look, U'x'), 2};
    case RingMark::State::kComing:
      return {pale_ink(PaleMark::kRing, look, U'.', 0.4), 1};
    case RingMark::State::kFree:
      break;
  }
  return {pale_ink(PaleMark::kRing, look, U'o', 1.0, kBold), 0};
}

void draw_ring(const RingMark& ring, const Badges& badges, GroundCanvas& canvas) {
  const auto [ink, dash] = line_of(ring, badges, canvas.look());
  if (ring.state != RingMark::State::kComing) canvas.disc(ring.at, ring.radius, {ink.color, U' ', 0.22});
  canvas.ellipse(ring.at, {1.0, 0.0}, ring.radius, ring.radius, ink, dash);
}

/// Lice on the place hide its line: it shines through them.
void draw_ring_over_lice(const RingMark& ring, const Badges& badges, GroundCanvas& canvas) {
  auto [ink, dash] = line_of(ring, badges, canvas.look());
  ink.strength *= 0.5;
  if (canvas.has_pixels()) canvas.ellipse(ring.at, {1.0, 0.0}, ring.radius, ring.radius, ink, dash);
}

/// Metres that a dot covers around a place.
double metres_per_dot(core::Vec2 place, const GroundCanvas& canvas) {
  const auto here = canvas.spot(place);
  const auto east = canvas.spot(place + core::Vec2{1.0, 0.0});
  if (!here || !east) return 1.0;
  return 1.0 / std::max(1e-3, std::hypot(east->x - here->x, east->y - here->y));
}

void draw_ghost(const GhostMark& ghost, GroundCanvas& canvas) {
  for (std::size_t k = ghost.trail.size() % 2; k < ghost.trail.size(); k += 2) {  // a dotted way
    const auto at = canvas.spot(ghost.trail[k]);
    if (at && !at->is_hidden && canvas.has_pixels())
      canvas.dot(whole(at->x), whole(at->y), pale_ink(PaleMark::kGhost, canvas.look(), U'.', kGhostStrength));
  }
  if (!canvas.has_pixels()) {
    const auto at = canvas.spot(ghost.position);
    if (!at) return;
    canvas.dot(whole(at->x), whole(at->y), pale_ink(PaleMark::kGhost, canvas.look(), U'(', kGhostStrength));
    canvas.dot(whole(at->x) + 1, whole(at->y),
               pale_ink(PaleMark::kGhost, canvas.look(), U')', kGhostStrength));
    return;
  }
  // As long as the lice of this picture.
  const double half =
      (canvas.has_height() ? std::clamp(canvas.viewport().size.columns / 32.0, 2.2, 5.0) : 2.6) *
      metres_per_dot(ghost.position, canvas);
  const double across = canvas.has_height() ? 0.75 * half : half;
  canvas.ellipse(ghost.position, ghost.heading, half, across,
                 pale_ink(PaleMark::kGhost, canvas.look(), U'(', kGhostStrength), 0);
  canvas.line(ghost.position + (0.6 * half) * ghost.heading, ghost.position + half * ghost.heading,
              pale_ink(PaleMark::kGhost, canvas.look(), U'(', 2.0 * kGhostStrength), 0);
}

/// Writes near a cell: in it, above, below.
void write_near(int column, int row, std::u32string_view text, Rgb color, Attributes attributes,
                GroundCanvas& canvas) {
  const int left = column - static_cast<int>(text.size()) / 2;
  for (const int y : {row, row - 1, row + 1, row + 2})
    if (canvas.write(left, y, text, color, attributes)) return;
}

/// The glyph of a direction on the screen, and how many cells it leads on.
HeadingGlyph screen_glyph(const Spot& from, const Spot& to, const GroundCanvas& canvas) {
  const double down = (to.y - from.y) * 2.0 / canvas.dots_per_row();  // in columns
  return heading_glyph({to.x - from.x, -down});
}

/// An arrow as it is written. In ASCII a slash has no head: between the four it is the keys' two directions.
std::u32string arrow_text(const HeadingGlyph& arrow, const GroundCanvas& canvas) {
  constexpr char32_t kArrows[3][3] = {{U'↖', U'↑', U'↗'}, {U'←', U'+', U'→'}, {U'↙', U'↓', U'↘'}};
  if (canvas.has_pixels()) return {kArrows[arrow.rows + 1][arrow.columns + 1]};
  if (arrow.columns == 0 || arrow.rows == 0) return {static_cast<char32_t>(arrow.glyph)};
  return {arrow.rows < 0 ? U'N' : U'S', arrow.columns > 0 ? U'E' : U'W'};
}

void label_gate(const GateMark& gate, GroundCanvas& canvas) {
  const core::Vec2 middle = 0.5 * (gate.a + gate.b);
  const auto at = canvas.spot(middle);
  if (!at || at->is_hidden) return;
  std::u32string text = wide((gate.is_next ? "[" : "(") + gate.label + (gate.is_next ? "]" : ")"));
  const int column = whole(at->x);
  const int row = whole(at->y) / canvas.dots_per_row() - (canvas.has_height()   ? 2
                                                          : canvas.has_pixels() ? 1
                                                                                : 0);
  write_near(column, row, text,
             gate.is_next ? goal_color(canvas.look()) : pale_color(PaleMark::kGate, canvas.look()),
             gate.is_next ? kBold : kPlain, canvas);
  if (!gate.is_next) return;
  // Which way it is driven through: over the line, well off the posts.
  const core::Vec2 along = gate.b - gate.a;
  const double length = std::hypot(along.x, along.y);
  if (!(length > 0.0)) return;
  const core::Vec2 through{-along.y / length, along.x / length};
  const auto ahead = canvas.spot(middle + through);
  if (!ahead) return;
  const HeadingGlyph glyph = screen_glyph(*at, *ahead, canvas);
  const std::u32string arrow = arrow_text(glyph, canvas);
  const int half = static_cast<int>(text.size() + arrow.size()) / 2;
  canvas.write(
      column + glyph.columns * (half + 1) - (glyph.columns < 0 ? static_cast<int>(arrow.size()) - 1 : 0),
      row + glyph.rows, arrow, goal_color(canvas.look()));
}

void label_ghost(const GhostMark& ghost, GroundCanvas& canvas) {
  constexpr std::size_t kLongest = 16;
  const auto at = canvas.spot(ghost.position);
  if (!at || at->is_hidden) return;
  std::u32string name = printable(ghost.name, canvas.look().glyphs);
  if (name.size() > kLongest) name.resize(kLongest);
  const int row = whole(at->y) / canvas.dots_per_row();
  const int left = whole(at->x) - static_cast<int>(name.size()) / 2;
  const int off = canvas.has_pixels() ? 2 : 1;
  const int beside = canvas.has_pixels() ? 6 : 3;
  const int column = whole(at->x);
  const int length = static_cast<int>(name.size());
  for (const auto& [x, y] : {std::pair{left, row + off}, std::pair{left, row - off},
                             std::pair{column + beside, row}, std::pair{column - beside - length, row}})
    if (canvas.is_free(x - 1, y, 1) && canvas.is_free(x + length, y, 1) &&
        canvas.write(x, y, name, scaled(pale_color(PaleMark::kGhost, canvas.look()), 0.75), kPlain))
      return;
}

/// Beside your louse, towards what is wanted; where that is out of the picture also at its edge, with the
/// way.
void draw_pointer(const LouseMark& you, core::Vec2 target, core::Vec2 up, GroundCanvas& canvas) {
  const auto here = canvas.spot(you.position);
  const auto there = canvas.spot(target);
  if (!here || !there) return;
  const double rows = canvas.dots_per_row();
  const double dx = there->x - here->x;
  const double dy = (there->y - here->y) * 2.0 / rows;  // in columns, as dx
  const double length = std::hypot(dx, dy);
  const core::Vec2 way = target - you.position;  // named as the line over the map names it
  const std::u32string arrow = arrow_text(heading_glyph({core::cross(way, up), core::dot(way, up)}), canvas);
  const int column = whole(here->x);
  const int row = whole(here->y) / canvas.dots_per_row();
  constexpr double kReach = 7.0;  ///< [columns] between louse and arrow
  const double reach = canvas.has_pixels() ? kReach : 4.0;
  if (length > 1.5 * reach)
    canvas.write(column + static_cast<int>(std::lround(reach * dx / length)),
                 row + static_cast<int>(std::lround(reach * dy / length / 2.0)), arrow,
                 goal_color(canvas.look()));
  const Size size = canvas.viewport().size;
  const int to_column = whole(there->x);
  const int to_row = static_cast<int>(std::floor(there->y / rows));
  if (canvas.viewport().holds(to_column, to_row)) return;
  const std::u32string metres = wide(formatted("%.0f m", std::hypot(way.x, way.y)));
  const int text = static_cast<int>(metres.size() + arrow.size()) - 1;
  // Where the straight way leaves the picture.
  double t = 1.0;
  const auto limit = [&t](double at, double by, double low, double high) {
    if (by > 0.0) t = std::min(t, (high - at) / by);
    if (by < 0.0) t = std::min(t, (low - at) / by);
  };
  constexpr int kTop = 1;
  limit(here->x, dx, 1.0, size.columns - 2.0);
  limit(here->y / rows, dy / 2.0, kTop, size.rows - 3.0);
  const int edge_column = std::clamp(static_cast<int>(here->x + std::max(0.0, t) * dx), 1, size.columns - 2);
  const int edge_row =
      std::clamp(static_cast<int>(here->y / rows + std::max(0.0, t) * dy / 2.0), kTop, size.rows - 3);
  const bool fits = edge_column + 2 + text < size.columns;
  const std::u32string told = fits ? arrow + U" " + metres : metres + U" " + arrow;
  for (const int off : {0, -1, 1, -2})  // a louse may stand there
    if (canvas.write(fits ? edge_column : edge_column - 1 - text, edge_row + off, told,
                     goal_color(canvas.look())))
      return;
}

}  // namespace

void draw_marks(const Scene& scene, const Badges& badges, GroundCanvas& canvas) {
  for (const RingMark& ring : scene.course.rings) draw_ring(ring, badges, canvas);
  for (const GhostMark& ghost : scene.course.ghosts)
    draw_ghost(ghost, canvas);  // they wait where the gate is
  for (const GateMark& gate : scene.course.gates)
    if (!gate.is_next) draw_gate(gate, canvas);
  for (const GateMark& gate : scene.course.gates)
    if (gate.is_next) draw_gate(gate, canvas);
  for (const CrumbMark& crumb : scene.course.crumbs)
    if (!crumb.is_wanted) draw_crumb(crumb, canvas);
  for (const CrumbMark& crumb : scene.course.crumbs)
    if (crumb.is_wanted) draw_crumb(crumb, canvas);
}

std::vector<Viewport> next_gate_cells(const Scene& scene, const GroundCanvas& canvas) {
  std::vector<Viewport> cells;
  const auto add = [&](core::Vec2 place, int left, int above, Size size) {
    if (const auto at = canvas.spot(place); at && !at->is_hidden)
      cells.push_back({whole(at->x) - left, whole(at->y) / canvas.dots_per_row() - above, size});
  };
  const int high = canvas.has_height() ? 2 : 0;  // of posts, and of what is written over the line
  constexpr int kOfLine = 32;
  for (const GateMark& gate : scene.course.gates) {
    if (!gate.is_next) continue;
    for (const core::Vec2 post : {gate.a, gate.b}) add(post, 1, high, {3, high + 1});
    add(0.5 * (gate.a + gate.b), 2, std::max(1, high), {5, 1});
    for (int k = 1; k < kOfLine; ++k)
      add(gate.a + (static_cast<double>(k) / kOfLine) * (gate.b - gate.a), 0, 0, {1, 1});
  }
  return cells;
}

void draw_next_gate_over_lice(const Scene& scene, GroundCanvas& canvas) {
  if (!canvas.has_pixels()) return;
  for (const GateMark& gate : scene.course.gates)
    for (const core::Vec2 post : {gate.a, gate.b}) {
      const auto at = gate.is_next ? canvas.spot(post) : std::nullopt;
      if (!at || canvas.is_kept(whole(at->x), whole(at->y) / 2)) continue;
      if (!canvas.has_height()) canvas.uncover(whole(at->x), whole(at->y) / 2);  // a louse's letter
      draw_post(post, goal_ink(canvas.look(), U'#'), canvas);
    }
}

void draw_mark_labels(const Scene& scene, const Badges& badges, const std::vector<Viewport>& next_gate,
                      GroundCanvas& canvas) {
  for (const RingMark& ring : scene.course.rings) draw_ring_over_lice(ring, badges, canvas);
  const auto you = std::find_if(scene.lice.begin(), scene.lice.end(), [&scene](const LouseMark& louse) {
    return louse.is_you || (scene.spectating && louse.id == scene.follow_id);
  });
  for (const GateMark& gate : scene.course.gates)
    if (gate.is_next) label_gate(gate, canvas);
  for (const Viewport& cell : next_gate)  // what is written from here on is written beside it
    for (int y = 0; canvas.has_pixels() && y < cell.size.rows; ++y)
      for (int x = 0; x < cell.size.columns; ++x) canvas.keep(cell.column + x, cell.row + y);
  if (you != scene.lice.end() && you->is_you && scene.course.target)
    draw_pointer(*you, *scene.course.target, scene.course.up, canvas);
  for (const GateMark& gate : scene.course.gates)
    if (!gate.is_next) label_gate(gate, canvas);
  if (!scene.labels) return;
  for (const GhostMark& ghost : scene.course.ghosts) label_ghost(ghost, canvas);
}

}  // namespace woodlouse::client
