#include "client/play/look_choice.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <string_view>

namespace woodlouse::client {
namespace {

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Of terminals that answer no question about colours.
ColorMode color_by_name(const TerminalHints& hints) {
  constexpr std::array<std::string_view, 8> kTruecolor = {"direct",  "alacritty", "foot",    "kitty",
                                                          "wezterm", "ghostty",   "contour", "konsole"};
  if (hints.colorterm == "truecolor" || hints.colorterm == "24bit") return ColorMode::kTruecolor;
  const auto is_named = [&hints](std::string_view name) { return contains(hints.term, name); };
  if (std::any_of(kTruecolor.begin(), kTruecolor.end(), is_named)) return ColorMode::kTruecolor;
  return contains(hints.term, "256") ? ColorMode::k256 : ColorMode::k16;
}

}  // namespace

TerminalHints hints_of_environment() {
  TerminalHints hints;
  hints.term = environment("TERM");
  hints.colorterm = environment("COLORTERM");
  hints.no_color = !environment("NO_COLOR").empty();
  std::string locale = environment("LC_ALL");
  if (locale.empty()) locale = environment("LC_CTYPE");
  if (locale.empty()) locale = environment("LANG");
  for (char& c : locale) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
  hints.utf8 = contains(locale, "utf-8") || contains(locale, "utf8");
  return hints;
}

Look choose_look(ColorChoice color, GlyphChoice glyphs, const TerminalHints& hints,
                 const TerminalAnswers& answers) {
  assert(glyphs != GlyphChoice::kText);
  const auto detected = [&] {
    if (hints.no_color || hints.term.empty() || hints.term == "dumb" || hints.term.starts_with("vt")) {
      return ColorMode::kMono;
    }
    if (answers.truecolor()) return *answers.truecolor() ? ColorMode::kTruecolor : ColorMode::k256;
    return color_by_name(hints);
  };
  Look look;
  switch (color) {
    case ColorChoice::kAuto:
      look.color = detected();
      break;
    case ColorChoice::kTruecolor:
      look.color = ColorMode::kTruecolor;
      break;
    case ColorChoice::k256:
      look.color = ColorMode::k256;
      break;
    case ColorChoice::k16:
      look.color = ColorMode::k16;
      break;
    case ColorChoice::kMono:
      look.color = ColorMode::kMono;
      break;
  }
  const bool colourful = look.color == ColorMode::k256 || look.color == ColorMode::kTruecolor;
  const bool half = glyphs == GlyphChoice::kHalfBlocks ||
                    (glyphs == GlyphChoice::kAuto && colourful && answers.utf8().value_or(hints.utf8) &&
                     answers.narrow_blocks().value_or(true));
  look.glyphs = half ? GlyphSet::kHalfBlocks : GlyphSet::kAscii;
  return look;
}

}  // namespace woodlouse::client
