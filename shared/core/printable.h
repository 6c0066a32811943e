// Text from outside, made fit for a terminal or a log: the one rule for file names, options, keys and values
// of files, names, whatever the program did not write itself.
#pragma once

#include <string>
#include <string_view>

namespace woodlouse::core {

/// C0, DEL and C1.
constexpr bool is_control(char32_t code) { return code < 0x20 || (code >= 0x7f && code < 0xa0); }

/// Whether a reader sees it, where it stands: false for control characters, for those that end a line or turn
/// the direction of writing, and for those without a shape of their own.
bool is_printable(char32_t code);

/// The text with a "?" for every character that is not printable and every byte that is not UTF-8: it stays
/// one line, says nothing to a terminal and hides nothing. Twice changes nothing.
std::string printable(std::string_view text);

}  // namespace woodlouse::core
