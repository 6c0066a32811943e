#include "client/play/look_choice.h"

#include <catch2/catch.hpp>

using namespace woodlouse::client;

namespace {

TerminalHints named(const char* term, const char* colorterm = "", bool no_color = false, bool utf8 = false) {
  return {term, colorterm, no_color, utf8};
}

TerminalAnswers answers_of(const std::vector<TerminalInput>& inputs) {
  TerminalAnswers answers;
  for (const TerminalInput& input : inputs) REQUIRE(answers.take(input));
  return answers;
}

const SettingReport kTrue{true, "0;48:2:1:2:3m"};
const SettingReport kIndexed{true, "0;48:5:16m"};

ColorMode color(const TerminalHints& hints, const std::vector<TerminalInput>& inputs,
                ColorChoice choice = ColorChoice::kAuto) {
  return choose_look(choice, GlyphChoice::kAuto, hints, answers_of(inputs)).color;
}
GlyphSet glyphs(const TerminalHints& hints, const std::vector<TerminalInput>& inputs,
                GlyphChoice choice = GlyphChoice::kAuto) {
  return choose_look(ColorChoice::kTruecolor, choice, hints, answers_of(inputs)).glyphs;
}

}  // namespace

TEST_CASE("a terminal's answer rules over its name, and names where nothing is answered") {
  CHECK(color(named("xterm"), {kTrue}) == ColorMode::kTruecolor);
  CHECK(color(named("xterm", "truecolor"), {kIndexed}) == ColorMode::k256);
  CHECK(color(named("xterm"), {SettingReport{false, "m"}}) == ColorMode::k16);
  CHECK(color(named("xterm"), {}) == ColorMode::k16);
  CHECK(color(named("xterm-256color"), {}) == ColorMode::k256);
  for (const char* name : {"alacritty", "foot", "xterm-kitty", "xterm-direct", "xterm-ghostty"})
    CHECK(color(named(name), {}) == ColorMode::kTruecolor);
}

TEST_CASE("what the user said rules over every answer") {
  CHECK(color(named("xterm", "", true), {kTrue}) == ColorMode::kMono);
  CHECK(color(named("xterm", "", true), {}, ColorChoice::k16) == ColorMode::k16);
  CHECK(color(named("xterm"), {kTrue}, ColorChoice::kMono) == ColorMode::kMono);
  CHECK(glyphs(named("xterm"), {CursorReport{1, 3}, CursorReport{1, 4}}, GlyphChoice::kHalfBlocks) ==
        GlyphSet::kHalfBlocks);
  CHECK(glyphs(named("xterm"), {CursorReport{1, 2}, CursorReport{1, 2}}, GlyphChoice::kAscii) ==
        GlyphSet::kAscii);
}

TEST_CASE("half-blocks are drawn where UTF-8 is shown and a block is one column wide") {
  const TerminalHints no_utf8 = named("xterm");
  const TerminalHints utf8 = named("xterm", "", false, true);
  CHECK(glyphs(no_utf8, {CursorReport{7, 2}, CursorReport{7, 2}}) == GlyphSet::kHalfBlocks);
  CHECK(glyphs(utf8, {CursorReport{7, 3}, CursorReport{7, 4}}) == GlyphSet::kAscii);
  CHECK(glyphs(utf8, {CursorReport{7, 2}, CursorReport{7, 3}}) == GlyphSet::kAscii);
  CHECK(glyphs(utf8, {}) == GlyphSet::kHalfBlocks);
  CHECK(glyphs(no_utf8, {}) == GlyphSet::kAscii);
}
