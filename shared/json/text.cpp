#include "shared/json/text.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "shared/core/stable_hash.h"
#include "shared/json/digits.h"
#include "shared/json/utf8.h"

namespace woodlouse::json {
namespace {

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
      break;
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  out += "\\u00";
  out += kDigits[byte >> 4];
  out += kDigits[byte & 15u];
}

}  // namespace

void append_integer(std::string& out, long long value) {
  char buffer[kMaxNumberChars];
  out.append(buffer, write_integer(buffer, value));
}

void append_integer(std::string& out, unsigned long long value) {
  char buffer[kMaxNumberChars];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void append_double(std::string& out, double value) {
  char buffer[kMaxNumberChars];
  out.append(buffer, write_double(buffer, value));
}

std::string double_text(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

char* write_integer(char* to, long long value) {
  // Without a branch on the sign either.
  const auto sign = static_cast<unsigned long long>(value >> 63);  // all bits or none
  const unsigned long long size = (static_cast<unsigned long long>(value) ^ sign) - sign;
  if (size >= kDigitsBelow) return std::to_chars(to, to + kMaxNumberChars, value).ptr;
  *to = '-';
  return write_digits(to + (sign & 1), static_cast<std::uint32_t>(size));
}

char* write_double(char* to, double value) {
  assert(std::isfinite(value));
  char* const end = std::to_chars(to, to + kMaxNumberChars, value).ptr;
  const bool minus_zero = value == 0.0 && std::signbit(value);
  return minus_zero ? std::copy_n("-0.0", 4, to) : end;
}

void append_hash(std::string& out, std::uint64_t value) {
  out += '"';
  out += core::to_hex(value);
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
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
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

std::string shown(std::string_view text, std::size_t max_bytes) {
  constexpr char32_t kFirstPrintable = 0x20, kDelete = 0x7f, kAfterControls = 0xa0;
  std::string out;
  while (!text.empty()) {
    const Utf8Character c = first_character(text);
    if (out.size() + c.size > max_bytes) return out += "...";
    const bool is_control = c.code < kFirstPrintable || (c.code >= kDelete && c.code < kAfterControls);
    if (c.valid && !is_control) {
      out += text.substr(0, c.size);
    } else {
      out += '?';
    }
    text.remove_prefix(c.size);
  }
  return out;
}

}  // namespace woodlouse::json
