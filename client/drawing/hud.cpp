#include "client/drawing/hud.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/drawing/course/profile.h"
#include "client/drawing/formatted.h"
#include "client/drawing/frame_box.h"
#include "client/drawing/labels.h"
#include "client/drawing/palette.h"
#include "client/drawing/replay_bar.h"
#include "client/drawing/wrapping.h"
#include "shared/core/stable_hash.h"

namespace woodlouse::client {
namespace {

/// The first that fits, else the last: a word cut off in the middle says something else.
std::string fitting(int width, std::initializer_list<std::string> choices) {
  for (const std::string& choice : choices)
    if (static_cast<int>(choice.size()) <= width) return choice;
  return *(choices.end() - 1);
}

std::string thrust_text(const HudNumbers& hud, int width) {
  const int strength = static_cast<int>(std::lround(3.0 * std::min(1.0, std::abs(hud.thrust))));
  const std::string signs(static_cast<std::size_t>(strength), hud.thrust < 0.0 ? '-' : '+');
  std::string text = formatted("push   %-3s", signs.c_str());
  if (strength == 0 && !hud.cruise) return "push   none";
  if (hud.cruise) return text + " cruise";
  const std::string word = hud.thrust < 0.0 ? " brake" : "";
  if (hud.push_seconds <= 0.0) return text + word;
  const std::string left = formatted(" %.1f s", hud.push_seconds);
  return fitting(width, {text + word + (word.empty() ? "" : " ") + left, text + left});
}

std::string slope_text(double degrees, int width) {
  const std::string number = formatted("slope  %+d deg ", static_cast<int>(std::lround(degrees)));
  const std::string way = degrees > 1.0 ? "up" : degrees < -1.0 ? "down" : "level";
  return fitting(width, {number + way + (way == "level" ? "" : "hill"), number + way});
}

void draw_players(const Scene& scene, const Badges& badges, const Styles& styles, PanelWriter& out,
                  int rows) {
  const int width = out.width();
  constexpr int kMeasure = 8;
  constexpr int kBar = 8;
  const auto all = shown_rows(scene.scores, rows);
  int letter = 3;  // its column: behind the longest rank and a blank
  for (const ScoreRow* row : all)
    letter = std::max(letter, static_cast<int>(std::to_string(row->rank).size()) + 1);
  for (const ScoreRow* shown : all) {
    const ScoreRow& row = *shown;
    // rank, letter, name, bar, measure
    const bool has_bar = row.share >= 0.0 && width >= letter + 2 + 6 + kBar + kMeasure;
    const int name_width = std::max(4, width - letter - 2 - kMeasure - 1 - (has_bar ? kBar : 0));
    const Badge badge = badges.of(row.id);
    Style style = row.is_you ? styles.strong : styles.text;
    if (scene.look.color != ColorMode::kMono && scene.look.color != ColorMode::k16)
      style.foreground = Color::of(badge.color);
    const std::u32string name = shown_name(row.name, row.kind, row.is_you, scene.look.glyphs, name_width);
    out.begin_row();
    if (row.rank > 0) out.text(0, formatted("%*d", letter - 1, row.rank), styles.dim);
    out.text(letter, std::string(1, badge.letter), style);
    out.text(letter + 2, name, style);
    if (has_bar) {
      const int full = static_cast<int>(std::lround(std::clamp(row.share, 0.0, 1.0) * (kBar - 1)));
      const int left = width - kMeasure - kBar;
      out.text(left, std::string(static_cast<std::size_t>(full), '='), style);
      out.text(left + full, std::string(static_cast<std::size_t>(kBar - 1 - full), '.'), styles.dim);
    }
    const std::string measure = row.measure.empty() ? formatted("%.0f m", row.distance) : row.measure;
    out.text(width - static_cast<int>(measure.size()), measure, row.is_you ? styles.strong : styles.text);
  }
}

void draw_you(const Scene& scene, const Styles& styles, PanelWriter& out) {
  if (scene.silence) {
    for (const char* unknown :
         {"speed    -- m/s", "slope    --", "push     --", "way      -- m", "height   -- m"})
      out.line(unknown, styles.dim);
    return;
  }
  const HudNumbers& hud = scene.hud;
  constexpr double kFullBar = 12.0;  ///< [m/s]
  const int bar = std::max(0, out.width() - 19);
  const int full = static_cast<int>(std::lround(std::clamp(hud.speed / kFullBar, 0.0, 1.0) * bar));
  out.line(formatted("speed %5.2f m/s", hud.speed), styles.text);
  if (bar >= 4) {
    out.text(16, "[", styles.dim);
    out.text(17, std::string(static_cast<std::size_t>(full), '#'), styles.strong);
    out.text(17 + full, std::string(static_cast<std::size_t>(bar - full), '-'), styles.dim);
    out.text(17 + bar, "]", styles.dim);
  }
  if (hud.above > 0.0)
    out.line(formatted("flies %6.1f m high", hud.above), styles.strong);
  else
    out.line(slope_text(hud.slope_degrees, out.width()), styles.text);
  out.line(thrust_text(hud, out.width()), styles.text);
  out.line(formatted("way   %6.1f m", hud.distance), styles.text);
  out.line(formatted("height %5.1f m", std::abs(hud.height) < 0.05 ? 0.0 : hud.height), styles.text);
}

/// How far the steps of the louse above err (match/error_reading.h).
void draw_error(const HudNumbers& hud, const Styles& styles, PanelWriter& out) {
  if (!hud.error) {
    for (const char* unknown : {"error    -- m/s", "worst    -- m", "twin     -- m"})
      out.line(unknown, styles.dim);
    return;
  }
  const match::ErrorReading& error = *hud.error;
  const auto tick = static_cast<unsigned long long>(error.worst_tick);
  out.line(formatted("error %7.1e m/s", error.of_play), styles.text);
  out.line(fitting(out.width(), {formatted("worst %7.1e m at tick %llu", error.worst, tick),
                                 formatted("worst %7.1e m", error.worst)}),
           styles.text);
  const std::string twin = formatted("twin  %7.1e m", error.apart);
  out.line(fitting(out.width(), {twin + formatted(" after %.0f s", error.apart_seconds),
                                 twin + formatted(" %.0f s", error.apart_seconds)}),
           styles.text);
}

void draw_room(const Scene& scene, const Styles& styles, PanelWriter& out) {
  out.line(formatted("lice   %d", scene.hud.players), styles.text);
  out.line(formatted("bots   %d", scene.hud.bots), styles.text);
  const int others = scene.hud.spectators - 1;
  const std::string alone = "you are watching";
  out.line(others > 0 ? fitting(out.width(), {formatted("you and %d more are watching", others),
                                              formatted("%d watch with you", others)})
                      : alone,
           styles.dim);
}

/// The ground before your louse, where half of a big panel is free for it.
void draw_ahead(const Scene& scene, const Styles& styles, int room, PanelWriter& out) {
  constexpr int kRows = 10;  // with the title
  if (room < kRows || scene.terrain == nullptr || out.width() < 24) return;
  const auto you =
      std::find_if(scene.lice.begin(), scene.lice.end(), [](const LouseMark& louse) { return louse.is_you; });
  if (you == scene.lice.end() || !scene.terrain->domain().contains(you->position.x, you->position.y)) return;
  out.title(formatted("AHEAD %.0f m", profile_reach(scene)) +
            (scene.course.climbs ? "  ^ needs a run-up" : ""));
  draw_profile(scene, *you, styles, kRows - 1, out);
}

/// Whose numbers a recording shows: "a ada".
std::string followed_text(const Scene& scene, const Badges& badges) {
  const auto louse = std::find_if(scene.lice.begin(), scene.lice.end(),
                                  [&](const LouseMark& mark) { return mark.id == scene.follow_id; });
  if (louse == scene.lice.end()) return "NOBODY IS THERE";
  std::string text{badges.of(louse->id).letter, ' '};
  for (const char32_t c : printable(louse->name, GlyphSet::kAscii)) text += static_cast<char>(c);
  if (louse->kind == LouseKind::kBot) text += '*';
  return text;
}

void draw_chat(const Scene& scene, const Styles& styles, PanelWriter& out, int rows) {
  struct Line {
    std::u32string text;
    bool is_notice;
  };
  std::vector<Line> lines;
  for (const ChatLine& chat : scene.chat) {
    const bool is_notice = chat.from.empty();
    const std::string whole = is_notice ? "* " + chat.text : "<" + chat.from + "> " + chat.text;
    for (std::u32string& part : wrapped(printable(whole, scene.look.glyphs), out.width()))
      lines.push_back({std::move(part), is_notice});
  }
  const std::size_t shown = std::min(lines.size(), static_cast<std::size_t>(std::max(0, rows)));
  for (const Line& line : std::span(lines).last(shown)) {
    out.begin_row();
    out.text(0, line.text, line.is_notice ? styles.dim : styles.text);
  }
}

std::string_view view_text(const Scene& scene) {
  switch (scene.view) {
    case View::kMap:
      return "map";
    case View::kOblique:
      return paints_pixels(scene.look) ? "oblique" : "map";
    case View::kFollow:
      return "follow";
    case View::kSlope:
      return "slope";
  }
  return "";
}

/// "WASD", or with words between.
std::string four_keys(const KeyLabels& keys) {
  const std::string joined = keys.up + keys.left + keys.down + keys.right;
  return joined.size() == 4 ? joined : keys.up + "/" + keys.left + "/" + keys.down + "/" + keys.right;
}

std::string keys_text(const Scene& scene, bool is_narrow) {
  const KeyLabels& keys = scene.keys;
  const std::string gap = is_narrow ? " " : "  ";
  const std::string scores = keys.scores + " scores" + gap;
  const std::string end = keys.help + " help" + gap + keys.quit + " quit";
  const std::string chat = keys.chat + " chat" + gap;
  if (scene.spectating) {
    const std::string next = keys.next + (is_narrow ? " next " : " next louse  ");
    return is_narrow ? " " + scores + chat + keys.view + " view " + next + end
                     : " watching   " + next + keys.zoom_in + "/" + keys.zoom_out + " zoom  " + scores +
                           chat + keys.view + " view  " + end;
  }
  const std::string driving =
      keys.compass ? four_keys(keys) + " push" + gap + keys.brake + " brake"
                   : keys.up + " push " + keys.down + " brake " + keys.left + "/" + keys.right + " turn";
  return " " + driving + gap + keys.cruise + " cruise" + gap + (is_narrow ? "" : scores) + chat +
         (is_narrow ? "" : keys.view + " view" + gap) + end;
}

}  // namespace

std::vector<const ScoreRow*> shown_rows(const std::vector<ScoreRow>& scores, int rows) {
  std::vector<const ScoreRow*> shown;
  for (const ScoreRow& row : scores) {
    if (static_cast<int>(shown.size()) < rows)
      shown.push_back(&row);
    else if (row.is_you && !shown.empty())
      shown.back() = &row;
  }
  return shown;
}

std::string proof_text(const StateProof& proof) {
  if (proof.differs) return "state DIFFERS at tick " + std::to_string(*proof.differs);
  if (!proof.total) return "state ok " + std::to_string(proof.verified);
  return "state ok " + core::to_hex(proof.hash).substr(12) + " " + std::to_string(proof.verified) + "/" +
         std::to_string(*proof.total) + (proof.cut_off ? ", cut off" : "");
}

void draw_status_line(const Scene& scene, CellBuffer& cells) {
  if (scene.replay) return draw_replay_status_line(scene, cells);
  const Styles styles = styles_for(scene.look);
  const int columns = cells.size().columns;
  const HudNumbers& hud = scene.hud;
  cells.fill(0, 0, {columns, 1}, styles.bar);
  Style title = styles.bar;
  title.attributes = kBold;
  int at = cells.text(1, 0, "WOODLOUSE", title);
  if (scene.lost)
    at = cells.text(at + 2, 0,
                    formatted("connection lost: coming back ... %.0f", std::ceil(scene.lost->seconds_left)),
                    styles.warning);
  if (scene.silence && !scene.lost)
    at = cells.text(at + 2, 0, formatted("no word for %.0f s", std::floor(*scene.silence)), styles.warning);
  if (scene.paused) at = cells.text(at + 2, 0, "stands still", styles.warning);
  at = cells.text(at + 2, 0, printable(scene.map_name, scene.look.glyphs), styles.bar, 24);
  if (scene.lost) return;  // the numbers are those of before
  if (columns >= 80) at = cells.text(at + 2, 0, view_text(scene), styles.dim_bar);
  std::string middle = scene.spectating ? "watching"
                       : scene.silence  ? (columns < 80 ? "" : "#-- of --")
                       : hud.rank > 0   ? formatted("#%d of %d", hud.rank, hud.players)
                                        : "";
  at = cells.text(at + 3, 0, middle, styles.bar);
  if (scene.proof)
    at = cells.text(at + 2, 0, proof_text(*scene.proof), scene.proof->differs ? styles.warning : styles.bar);
  std::string right = hud.rtt_ms && !scene.silence ? formatted("rtt %.0f ms", *hud.rtt_ms) : "rtt --";
  right += scene.silence ? formatted("  srv --  fps %.0f", hud.fps)
                         : formatted("  srv %.0f  fps %.0f", hud.tick_hz, hud.fps);
  cells.text(std::max(at + 2, columns - 1 - static_cast<int>(right.size())), 0, right, styles.bar);
}

void draw_key_line(const Scene& scene, const Layout& layout, CellBuffer& cells) {
  const Styles styles = styles_for(scene.look);
  const int columns = cells.size().columns;
  if (layout.rule_row >= 0 && !scene.replay)
    cells.text(0, layout.rule_row, std::string(static_cast<std::size_t>(columns), '-'), styles.dim);
  cells.fill(0, layout.key_row, {columns, 1}, styles.bar);
  if (scene.mode == Mode::kChatEntry) {
    const int at = cells.text(0, layout.key_row, " say: ", styles.bar);
    const std::string hint = "  (Enter sends, Esc cancels)";
    const int room = columns - at - 1 - static_cast<int>(hint.size());
    std::u32string typed = printable(scene.chat_entry, scene.look.glyphs);
    if (static_cast<int>(typed.size()) > room) typed.erase(0, typed.size() - static_cast<std::size_t>(room));
    const int caret = cells.text(at, layout.key_row, typed, styles.bar);
    Style block = styles.bar;
    block.attributes = kReverse;
    cells.put(caret, layout.key_row, U' ', block);
    cells.text(columns - static_cast<int>(hint.size()), layout.key_row, hint, styles.bar);
  } else if (scene.replay) {
    draw_scrubber(scene, layout, cells);
    draw_replay_key_line(scene, layout, cells);
  } else {
    const std::string wide = keys_text(scene, false);
    const bool fits = columns >= 80 && static_cast<int>(wide.size()) <= columns;
    cells.text(0, layout.key_row, fits ? wide : keys_text(scene, true), styles.bar);
  }
  const std::string& said =
      scene.notice.empty() && scene.lost ? scene.lost->reason : scene.notice;  // a notice passes
  if (said.empty()) return;
  const std::u32string notice = printable(said, scene.look.glyphs);
  const int row = layout.map.row + layout.map.size.rows - 1;
  cells.put(0, row, U' ', styles.warning);
  const int end = cells.text(1, row, notice, styles.warning, layout.map.size.columns - 2);
  cells.put(end, row, U' ', styles.warning);
}

void draw_panel(const Scene& scene, const Badges& badges, const Viewport& panel, CellBuffer& cells) {
  const Styles styles = styles_for(scene.look);
  PanelWriter out(panel, scene.look, styles, cells);
  const bool shows_room = scene.spectating && !scene.replay;
  const bool shows_error = scene.hud.asks_error && !shows_room;
  const int you_rows = shows_room ? 3 : shows_error ? 8 : 5;
  constexpr int kFrames = 4;  // three titles and the foot
  constexpr int kLeastChat = 3;
  const int watchers_rows = scene.hud.spectators > 0 && !scene.spectating ? 1 : 0;
  const int most = std::max(1, panel.size.rows - kFrames - you_rows - kLeastChat - watchers_rows);
  const int players = std::clamp(static_cast<int>(scene.scores.size()), 1, std::min(most, 16));
  out.title(formatted("PLAYERS %d (%d %s)", scene.hud.players, scene.hud.bots,
                      scene.hud.bots == 1 ? "bot" : "bots"));
  draw_players(scene, badges, styles, out, players);
  out.skip_to(1 + players);
  if (watchers_rows > 0) out.line(formatted("%3d watching", scene.hud.spectators), styles.dim);
  out.title(shows_room ? "THE ROOM" : scene.replay ? followed_text(scene, badges) : "YOU");
  shows_room ? draw_room(scene, styles, out) : draw_you(scene, styles, out);
  if (shows_error) draw_error(scene.hud, styles, out);
  draw_ahead(scene, styles, panel.size.rows - out.rows_used() - kLeastChat - 2, out);
  out.title(scene.replay ? "CHAT" : "CHAT  (" + scene.keys.chat + " to talk)");
  draw_chat(scene, styles, out, panel.size.rows - out.rows_used() - 1);
  out.finish();
}

}  // namespace woodlouse::client
