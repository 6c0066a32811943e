// What a terminal is drawn with: what the player chose, else what it answered, else what the environment
// tells.
#pragma once

#include <cstdint>
#include <string>

#include "client/drawing/scene.h"
#include "client/terminal/terminal_answers.h"

namespace woodlouse::client {

enum class ColorChoice : std::uint8_t { kAuto, kTruecolor, k256, k16, kMono };
enum class GlyphChoice : std::uint8_t { kAuto, kHalfBlocks, kAscii, kText };

/// What the environment tells about the terminal.
struct TerminalHints {
  std::string term;       ///< TERM
  std::string colorterm;  ///< COLORTERM
  bool no_color = false;  ///< NO_COLOR is set and not empty
  bool utf8 = false;      ///< the locale's encoding
};
TerminalHints hints_of_environment();

/// The look that choices, answers and hints come to. REQUIRES glyphs other than kText.
Look choose_look(ColorChoice color, GlyphChoice glyphs, const TerminalHints& hints,
                 const TerminalAnswers& answers);

}  // namespace woodlouse::client
