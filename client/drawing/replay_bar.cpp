#include "client/drawing/replay_bar.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "client/drawing/formatted.h"
#include "client/drawing/hud.h"
#include "client/drawing/labels.h"
#include "client/drawing/palette.h"

namespace woodlouse::client {
namespace {

/// "03:12.4"; hours only where there are some.
std::string time_text(double seconds) {
  const auto tenths = static_cast<long>(std::floor(seconds * 10.0 + 1e-6));
  const long minutes = tenths / 600;
  const std::string hours = minutes >= 60 ? formatted("%ld:", minutes / 60) : std::string();
  return hours + formatted("%02ld:%02ld.%ld", minutes % 60, tenths / 10 % 60, tenths % 10);
}

std::string speed_text(double speed) {
  if (speed >= 10.0) return formatted("x%.0f", speed);
  return speed < 1.0 ? formatted("x%.2f", speed) : formatted("x%.1f", speed);
}

char sign_of(EventSign sign) {
  switch (sign) {
    case EventSign::kJoined:
      return '+';
    case EventSign::kLeft:
      return 'x';
    case EventSign::kRespawned:
      return 'o';
    case EventSign::kChat:
      return '!';
  }
  return '?';
}

/// The bar without its brackets. Of the signs in one cell the rarest kind wins: chat over leaving over
/// joining.
std::string bar_text(const ReplayBar& bar, int width) {
  const auto cell_of = [&](double seconds) {
    const double part = bar.total_seconds > 0.0 ? seconds / bar.total_seconds : 0.0;
    return static_cast<std::size_t>(std::clamp(static_cast<int>(part * width), 0, width - 1));
  };
  std::string text(static_cast<std::size_t>(width), '-');
  const bool at_end = bar.seconds >= bar.total_seconds;
  std::fill_n(text.begin(), at_end ? text.size() : cell_of(bar.seconds), '#');
  if (!at_end) text[cell_of(bar.seconds)] = '|';
  if (bar.marks == nullptr) return text;
  std::string signs(text.size(), ' ');
  const std::string by_weight = " o+x!";
  for (const EventMark& mark : *bar.marks) {
    char& sign = signs[cell_of(mark.seconds)];
    if (by_weight.find(sign_of(mark.sign)) > by_weight.find(sign)) sign = sign_of(mark.sign);
  }
  for (std::size_t i = 0; i < text.size(); ++i)
    if (signs[i] != ' ' && text[i] != '|') text[i] = signs[i];
  return text;
}

}  // namespace

void draw_replay_status_line(const Scene& scene, CellBuffer& cells) {
  const Styles styles = styles_for(scene.look);
  const int columns = cells.size().columns;
  cells.fill(0, 0, {columns, 1}, styles.bar);
  Style title = styles.bar;
  title.attributes = kBold;
  int at = cells.text(1, 0, columns < 80 ? "REPLAY" : "WOODLOUSE REPLAY", title);
  const std::string lice = formatted(scene.hud.players == 1 ? "%d louse" : "%d lice", scene.hud.players);
  const std::string proof = scene.proof ? proof_text(*scene.proof) : std::string();
  const int behind = static_cast<int>(lice.size() + proof.size()) + 5;  // and blanks
  at = cells.text(at + 2, 0, printable(scene.replay->file, scene.look.glyphs), styles.bar,
                  std::max(columns < 80 ? 14 : 20, columns - at - 2 - behind));
  at = cells.text(at + 2, 0, lice, styles.bar);
  if (!scene.proof) return;
  cells.text(std::max(at + 2, columns - 1 - static_cast<int>(proof.size())), 0, proof,
             scene.proof->differs ? styles.warning : styles.bar);
}

void draw_scrubber(const Scene& scene, const Layout& layout, CellBuffer& cells) {
  const Styles styles = styles_for(scene.look);
  const ReplayBar& bar = *scene.replay;
  const int columns = cells.size().columns;
  const int row = layout.rule_row;
  cells.fill(0, row, {columns, 1}, styles.bar);
  const std::string speed = speed_text(bar.speed);
  const std::string tail =
      "]  " + time_text(bar.total_seconds) + "  " + std::string(5 - speed.size(), ' ') + speed;
  int at = cells.text(1, row, bar.playing ? "|>" : "||", styles.strong);
  at = cells.text(at + 2, row, time_text(bar.seconds), styles.strong);
  at = cells.text(at + 1, row, "[", styles.bar);
  const int width = columns - at - static_cast<int>(tail.size()) - 1;
  at = cells.text(at, row, bar_text(bar, width), styles.bar);
  cells.text(at, row, tail, styles.bar);
}

void draw_replay_key_line(const Scene& scene, const Layout& layout, CellBuffer& cells) {
  const Styles styles = styles_for(scene.look);
  const int columns = cells.size().columns;
  cells.fill(0, layout.key_row, {columns, 1}, styles.bar);
  cells.text(0, layout.key_row,
             columns < 80
                 ? " SPC pause </> 5s ,/. tick [/] speed F follow ? help Q quit"
                 : " SPC pause  </> 5s ,/. tick [/] speed 0-9 jump F follow  N event  ? help  Q quit",
             styles.bar);
}

}  // namespace woodlouse::client
