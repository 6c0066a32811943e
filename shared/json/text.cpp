#include "shared/json/text.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "shared/core/printable.h"
#include "shared/core/stable_hash.h"
#include "shared/core/utf8.h"
#include "shared/json/decimal.h"
#include "shared/json/decimal_number.h"

namespace woodlouse::json {
namespace {

void append_utf16_unit(std::string& out, char32_t unit) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  out += "\\u";
  for (int shift = 12; shift >= 0; shift -= 4) out += kDigits[(unit >> shift) & 15u];
}

void append_escaped(std::string& out, char c) {
  switch (c) {
    case '"':
      out += "\\\"";
      return;
    case '\\':
      out += "\\\\";
      return;
    case '\n':
      out += "\\n";
      return;
    case '\t':
      out += "\\t";
      return;
    case '\r':
      out += "\\r";
      return;
    default:
      append_code(out, static_cast<unsigned char>(c));
  }
}

}  // namespace

void append_integer(std::string& out, long long value) {
  char buffer[kNumberRoom];
  out.append(buffer, write_integer(buffer, value));
}

void append_integer(std::string& out, unsigned long long value) {
  char buffer[kNumberRoom];
  out.append(buffer, write_integer(buffer, value));
}

void append_double(std::string& out, double value) {
  char buffer[kNumberRoom];
  out.append(buffer, write_double(buffer, value));
}

std::string double_text(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

char* write_long_integer(char* to, unsigned long long value) {
  return std::to_chars(to, to + kNumberRoom, value).ptr;
}

char* write_double(char* to, double value) {
  assert(std::isfinite(value));
  *to = '-';
  if (has_decimal(value)) return write_decimal(to + (std::signbit(value) ? 1 : 0), shortest_decimal(value));
  if (value == 0.0) return std::signbit(value) ? std::copy_n("-0.0", 4, to) : std::fill_n(to, 1, '0');
  // Past it an exponent may be shorter.
  constexpr double kWholeBelow = 100000.0;
  if (value > -kWholeBelow && value < kWholeBelow) {
    const auto whole = static_cast<long long>(value);
    if (static_cast<double>(whole) == value) return write_integer(to, whole);
  }
  static_assert(kNumberRoom >= kShortestRoom);
  return write_shortest(to, value);
}

void append_hash(std::string& out, std::uint64_t value) {
  out += '"';
  core::append_hex(out, value);
  out += '"';
}

void append_pair(std::string& out, double x, double y) {
  append_double(out += '[', x);
  append_double(out += ',', y);
  out += ']';
}

void append_rows(std::string& out, std::span<const double> values, std::size_t columns) {
  assert(columns >= 1 && !values.empty() && values.size() % columns == 0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    out += k == 0 ? "[[" : k % columns == 0 ? "],[" : ",";
    append_double(out, values[k]);
  }
  out += "]]";
}

void append_string(std::string& out, std::string_view text) {
  out += '"';
  for (;;) {
    const auto end = std::find_if_not(text.begin(), text.end(), stands_as_it_is);
    const auto plain = static_cast<std::size_t>(end - text.begin());
    out += text.substr(0, plain);
    text.remove_prefix(plain);
    if (text.empty()) break;
    const core::Utf8Character character = core::first_character(text);
    if (!character.valid) {
      out += "\xef\xbf\xbd";
    } else if (character.code < 0x20 || character.code == 0x7f || text[0] == '"' || text[0] == '\\') {
      append_escaped(out, text[0]);
    } else {
      out += text.substr(0, character.size);
    }
    text.remove_prefix(character.size);
  }
  out += '"';
}

void append_code(std::string& out, char32_t code) {
  if (code < 0x10000) return append_utf16_unit(out, code);
  append_utf16_unit(out, 0xd800 + ((code - 0x10000) >> 10));
  append_utf16_unit(out, 0xdc00 + ((code - 0x10000) & 0x3ff));
}

std::string printable_json(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  while (!json.empty()) {
    const core::Utf8Character character = core::first_character(json);
    const bool is_plain = character.code < 0x7f || core::is_printable(character.code);  // below: blanks
    if (is_plain) {
      out += json.substr(0, character.size);
    } else {
      append_code(out, character.code);
    }
    json.remove_prefix(character.size);
  }
  return out;
}

std::string shown(std::string_view text, std::size_t max_bytes) {
  std::string out;
  while (!text.empty()) {
    const std::size_t size = core::first_character(text).size;
    if (out.size() + size > max_bytes) return out += "...";
    out += core::printable(text.substr(0, size));
    text.remove_prefix(size);
  }
  return out;
}

}  // namespace woodlouse::json
