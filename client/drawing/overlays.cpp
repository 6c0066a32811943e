#include "client/drawing/overlays.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "client/drawing/formatted.h"
#include "client/drawing/frame_box.h"
#include "client/drawing/hud.h"
#include "client/drawing/labels.h"
#include "client/drawing/layout.h"
#include "client/drawing/lice_on_map.h"
#include "client/drawing/palette.h"
#include "client/drawing/wrapping.h"

namespace woodlouse::client {
namespace {

int map_columns(Size screen) { return layout_for(screen, {}).map.size.columns; }

/// Over the map, where it is wide enough, so that no numbers beside it are cut.
Viewport centred(Size wanted, Size screen) {
  const Size size{std::min(wanted.columns, screen.columns), std::min(wanted.rows, screen.rows)};
  const int map = map_columns(screen);
  return {((size.columns <= map ? map : screen.columns) - size.columns) / 2, (screen.rows - size.rows) / 2,
          size};
}

std::string_view color_text(ColorMode mode) {
  switch (mode) {
    case ColorMode::kMono:
      return "mono";
    case ColorMode::k16:
      return "16";
    case ColorMode::k256:
      return "256";
    case ColorMode::kTruecolor:
      return "truecolor";
  }
  return "";
}

std::string_view palette_text(Palette palette) {
  return palette == Palette::kDeutan ? "deutan" : palette == Palette::kTritan ? "tritan" : "default";
}

/// A line of the help: a head in the margin, and what it says.
struct HelpLine {
  std::string_view head;
  std::string text;
};

std::vector<HelpLine> driving_help(const KeyLabels& keys) {
  const auto press = formatted("%.1f s a press", keys.pulse_seconds);
  const HelpLine cruise{
      "", formatted("%-10s cruise: the push stays on    %s respawn",
                    keys.cruise == "SPC" ? "Space" : keys.cruise.c_str(), keys.respawn.c_str())};
  const std::string four = keys.up + " " + keys.left + " " + keys.down + " " + keys.right;
  if (keys.compass)
    return {{"DRIVE", formatted("%-10s push that way: ", four.c_str()) + press},
            {"", "           two at once push between"},
            {"", formatted("%-10s brake", keys.brake.c_str())},
            cruise,
            {"", formatted("%-10s steer by a heading that two keys turn", keys.steer.c_str())}};
  const auto with_second = [](const std::string& first, const std::string& second) {
    return second.empty() ? first : first + " / " + second;
  };
  return {
      {"DRIVE", formatted("%-10s push along your heading: ", with_second(keys.up, keys.up2).c_str()) + press},
      {"", formatted("%-10s brake", with_second(keys.down, keys.down2).c_str())},
      {"", keys.left + " " + keys.right + " / left right   turn 22.5 degrees"},
      cruise,
      {"", formatted("%-10s steer by compass: keys push that way", keys.steer.c_str())}};
}

/// What stands for what in the picture.
std::vector<HelpLine> map_help(const Scene& scene, int columns) {
  if (!paints_pixels(scene.look))
    return {{"MAP", "Close lines are steep. You roll downhill for free,"},
            {"", "hills eat speed. @ is you, a-z others, * marks a"},
            {"", "bot. The glyph beside a letter is its heading" + std::string(scene.spectating ? "." : ",")},
            {"", std::string(scene.spectating ? "" : "beside yours where your push goes. ") +
                     (scene.look.color == ColorMode::kMono ? "" : "Low is blue.")}};
  std::vector<HelpLine> lines{{"MAP", "Low is blue, close lines are steep. You roll"},
                              {"", "downhill for free, hills eat speed. * marks a bot."}};
  const bool is_oblique = scene.view == View::kOblique || scene.view == View::kFollow;
  if (is_oblique || columns >= kColumnsForBodies) {
    lines.push_back({"", "Lice roll where their heads are, white or black."});
    if (!scene.spectating) lines.push_back({"", "The white bar at yours: where the next push goes."});
  } else {
    lines.push_back({"", "@ is you. Beside a letter stands its heading."});
    if (!scene.spectating) lines.push_back({"", "Beside yours, in white, where the next push goes."});
  }
  return lines;
}

std::vector<HelpLine> game_help(const Scene& scene, int columns) {
  const KeyLabels& keys = scene.keys;
  std::vector<HelpLine> lines;
  if (scene.spectating)
    lines = {{"WATCH", formatted("%-10s the next louse", keys.next.c_str())}};
  else
    lines = driving_help(keys);
  const std::string zoom = "  " + keys.zoom_in + "/" + keys.zoom_out + " zoom";
  lines.push_back({"SEE", keys.view + " view: map / oblique / follow / slope" + zoom});
  lines.push_back({"", keys.labels + " labels  " + keys.trails + " trails  " +
                           (keys.scores == "TAB" ? "Tab" : keys.scores) + " scores" +
                           (scene.spectating ? "" : "  " + keys.ghost + " ghosts  " + keys.gate + " gate")});
  if (!scene.spectating) lines.push_back({"", keys.error + " how far steps err, a twin at half the step"});
  lines.push_back({"TALK", keys.chat + " chat  Enter sends  Esc cancels  /skip next game"});
  lines.push_back({"QUIT", keys.quit + " (asks)   Ctrl-C (now; restores the terminal)"});
  const std::vector<HelpLine> map = map_help(scene, columns);
  lines.insert(lines.end(), map.begin(), map.end());
  return lines;
}

std::vector<HelpLine> replay_help() {
  return {{"TIME", "Space      play, pause; at the end: once more"},
          {"", "< >        5 s back, forth    also left and right"},
          {"", ", .        one tick back, forth"},
          {"", "[ ]        slower, faster: x0.25 to x16"},
          {"", "0-9        jump by tenths     Home End"},
          {"", "N Shift-N  next, previous event: + joined, x left,"},
          {"", "           o began again, ! chat"},
          {"SEE", "F Shift-F  follow the next, the previous louse"},
          {"", "V view: map / oblique / follow / slope  +/- zoom"},
          {"", "L labels   P trails   Tab scoreboard   E error"},
          {"QUIT", "Q          Ctrl-C (restores the terminal, too)"},
          {"PROOF", "state ok: the ticks that were re-run here, all of"},
          {"", "them with the very hash that was recorded."}};
}

void draw_help(const Scene& scene, const Styles& styles, CellBuffer& cells) {
  std::vector<HelpLine> lines = scene.replay ? replay_help() : game_help(scene, map_columns(cells.size()));
  for (std::size_t i = 0; i < scene.course.rules.size(); ++i)
    lines.push_back({i == 0 ? "RULES" : "", scene.course.rules[i]});
  const Viewport box = centred({60, static_cast<int>(lines.size()) + 5}, cells.size());
  draw_box(box, "HELP (any key closes)", scene.look, styles, cells);
  const int left = box.column + 2;
  constexpr int kLabelMargin = 6;
  int row = box.row + 1;
  for (const HelpLine& line : lines) {
    cells.text(left, row, line.head, styles.strong);
    cells.text(left + kLabelMargin, row++, line.text, styles.text, box.size.columns - kLabelMargin - 4);
  }
  const std::string keys = scene.key_up_known ? "hold and release" : "no key-up seen: a press is a pulse";
  const std::string glyphs = scene.look.glyphs == GlyphSet::kAscii ? "ascii" : "half-blocks";
  if (!scene.replay) cells.text(left, ++row, "keys: " + keys, styles.dim, box.size.columns - 4);
  const bool has_palette = scene.look.color == ColorMode::k256 || scene.look.color == ColorMode::kTruecolor;
  std::string shown = "color: " + std::string(color_text(scene.look.color)) + "  glyphs: " + glyphs;
  if (has_palette) shown += "  palette: " + std::string(palette_text(scene.look.palette));
  cells.text(left, ++row, shown, styles.dim, box.size.columns - 4);
}

void draw_scoreboard(const Scene& scene, const Badges& badges, const Styles& styles, CellBuffer& cells) {
  const int most = std::max(1, cells.size().rows - 8);
  const int rows = std::clamp(static_cast<int>(scene.scores.size()), 1, most);
  const Viewport box = centred({58, rows + 4}, cells.size());
  const bool by_distance = scene.measured.empty();
  draw_box(box, "SCORES  " + (by_distance ? "distance travelled" : scene.measured), scene.look, styles,
           cells);
  const int left = box.column + 2;
  constexpr int kKind = 29;
  constexpr int kSpeed = 34;
  constexpr int kMeasure = 54;  // its right end
  const auto to_the_right = [&](int y, const std::string& text, const Style& style) {
    cells.text(left + kMeasure - static_cast<int>(text.size()), y, text, style);
  };
  cells.text(left, box.row + 1, " #  louse", styles.dim);
  cells.text(left + kKind - 1, box.row + 1, "kind", styles.dim);
  cells.text(left + kSpeed + 5, box.row + 1, "speed", styles.dim);
  to_the_right(box.row + 1, by_distance ? "metres" : "score", styles.dim);
  int y = box.row + 2;
  for (const ScoreRow* shown : shown_rows(scene.scores, rows)) {
    const ScoreRow& row = *shown;
    const Style style = row.is_you ? styles.strong : styles.text;
    Style colored = style;
    if (scene.look.color != ColorMode::kMono) colored.foreground = Color::of(badges.of(row.id).color);
    if (row.rank > 0) cells.text(left, y, formatted("%2d", row.rank), styles.dim);
    cells.text(left + 4, y, std::string(1, badges.of(row.id).letter), colored);
    cells.text(left + 6, y, shown_name(row.name, row.kind, row.is_you, scene.look.glyphs, 21), colored);
    cells.text(left + kKind - 1, y, row.kind == LouseKind::kBot ? "bot" : "human", style);
    cells.text(left + kSpeed, y, formatted("%6.2f m/s", row.speed), style);
    to_the_right(y++, row.measure.empty() ? formatted("%.1f", row.distance) : row.measure, style);
  }
  const int hidden = static_cast<int>(scene.scores.size()) - rows;
  if (hidden > 0) cells.text(left, box.row + rows + 2, formatted("and %d more", hidden), styles.dim);
}

void draw_quit_question(const Scene& scene, const Styles& styles, CellBuffer& cells) {
  const Viewport box = centred({42, 5}, cells.size());
  draw_box(box, "LEAVE?", scene.look, styles, cells);
  cells.text(box.column + 3, box.row + 1,
             scene.spectating ? "Stop watching?" : "Your louse leaves the hill with you.", styles.text);
  cells.text(box.column + 3, box.row + 3, "Y or " + scene.keys.quit + " leaves, any other key stays",
             styles.strong, box.size.columns - 5);
}

}  // namespace

void draw_overlay(const Scene& scene, const Badges& badges, CellBuffer& cells) {
  const Styles styles = styles_for(scene.look);
  switch (scene.mode) {
    case Mode::kHelp:
      return draw_help(scene, styles, cells);
    case Mode::kScoreboard:
      return draw_scoreboard(scene, badges, styles, cells);
    case Mode::kQuitQuestion:
      return draw_quit_question(scene, styles, cells);
    case Mode::kPlay:
    case Mode::kChatEntry:
      return;
  }
}

void draw_too_small(const Scene& scene, CellBuffer& cells) {
  const Size size = cells.size();
  const std::string needs = formatted("WOODLOUSE needs %d x %d, this terminal is %d x %d.",
                                      kSmallestSize.columns, kSmallestSize.rows, size.columns, size.rows);
  const int left = std::clamp(size.columns - static_cast<int>(needs.size()), 0, 5);
  int row = size.rows >= 6 ? 1 : 0;
  if (static_cast<int>(needs.size()) <= size.columns) {
    cells.text(left, row, needs, {});
  } else {  // the sizes are what is wanted: nothing of them may be cut
    cells.text(left, row, formatted("WOODLOUSE needs %d x %d,", kSmallestSize.columns, kSmallestSize.rows),
               {});
    cells.text(left, ++row, formatted("this terminal is %d x %d.", size.columns, size.rows), {});
  }
  const auto told = [&](std::string_view text) {
    for (const std::u32string& line :
         wrapped(printable(text, GlyphSet::kAscii), std::max(1, size.columns - left)))
      cells.text(left, ++row, line, {});
  };
  told("Enlarge it, or zoom out (Ctrl and -).");
  if (size.rows >= 9) ++row;
  // How to leave comes first where there is not room for all.
  told(scene.mode == Mode::kQuitQuestion ? "Leave? Y or N." : scene.keys.quit + " leaves.");
  if (!scene.replay && !scene.spectating) told("The game goes on: your louse keeps rolling.");
}

}  // namespace woodlouse::client
