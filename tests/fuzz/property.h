// What a fuzz target demands of the code under test: a property that does not hold ends the program, which is
// how libFuzzer learns of it.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "shared/core/utf8.h"

namespace woodlouse::fuzz {

/// Ends the program, after saying what was demanded and what was found instead, unless `holds`.
inline void demand(bool holds, std::string_view what, std::string_view found = {}) {
  if (holds) return;
  std::cerr << "property violated: " << what << "\nfound: " << found << std::endl;
  std::abort();
}

/// Valid UTF-8 without control characters: nothing that breaks a line or speaks to a terminal.
inline bool is_plain_line(std::string_view text) {
  while (!text.empty()) {
    const core::Utf8Character c = core::first_character(text);
    if (!c.valid || c.code < 0x20 || (c.code >= 0x7f && c.code < 0xa0)) return false;
    text.remove_prefix(c.size);
  }
  return true;
}

inline constexpr std::size_t kMaxErrorBytes = 1000;

/// What is told to a person about bytes from outside: something, on one line, of a length one can read.
inline void demand_readable(std::string_view message) {
  demand(!message.empty(), "an error says something");
  demand(message.size() <= kMaxErrorBytes, "an error is short enough to be read", message);
  demand(is_plain_line(message), "an error is one line of plain text", message);
}

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace woodlouse::fuzz
