// Writes JSON, the same bytes everywhere: numbers as std::to_chars does, strings escaped.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "shared/json/digits.h"

namespace woodlouse::json {

/// The longest are "-2.2250738585072014e-308" and "-9223372036854775808"; where there is room for more,
/// digits are written by eights.
inline constexpr std::size_t kNumberRoom = 40;

void append_integer(std::string& out, long long value);
void append_integer(std::string& out, unsigned long long value);
template <std::unsigned_integral T>
void append_integer(std::string& out, T value) {
  append_integer(out, static_cast<unsigned long long>(value));
}
template <std::signed_integral T>
void append_integer(std::string& out, T value) {
  append_integer(out, static_cast<long long>(value));
}

/// The shortest text that reads back as the same double; minus zero is "-0.0", because readers take "-0" for
/// an integer and lose its sign. REQUIRES a finite value.
void append_double(std::string& out, double value);
std::string double_text(double value);

/// Quoted: 16 lower-case hex digits.
void append_hash(std::string& out, std::uint64_t value);
/// [x,y]
void append_pair(std::string& out, double x, double y);
/// [[row],[row],..] of values that stand row by row. REQUIRES columns >= 1 and whole rows, at least one.
void append_rows(std::string& out, std::span<const double> values, std::size_t columns);

/// As write_integer().
char* write_long_integer(char* to, unsigned long long value);

/// These write at `to`, which has room for kNumberRoom, and return the end; past it they may leave anything.
inline char* write_integer(char* to, unsigned long long value) {
  if (value < kDigitsBelow) return write_digits(to, static_cast<std::uint32_t>(value));
  return write_long_integer(to, value);
}
inline char* write_integer(char* to, long long value) {
  // Without a branch on the sign either.
  const auto sign = static_cast<unsigned long long>(value >> 63);  // all bits or none
  const unsigned long long size = (static_cast<unsigned long long>(value) ^ sign) - sign;
  *to = '-';
  return write_integer(to + (sign & 1), size);
}
template <std::unsigned_integral T>
char* write_integer(char* to, T value) {
  return write_integer(to, static_cast<unsigned long long>(value));
}
template <std::signed_integral T>
char* write_integer(char* to, T value) {
  return write_integer(to, static_cast<long long>(value));
}
/// REQUIRES a finite value.
char* write_double(char* to, double value);

/// In a JSON string, whatever stands beside it: ASCII but controls, quotes and backslashes.
constexpr bool stands_as_it_is(char c) { return c >= 0x20 && c < 0x7f && c != '"' && c != '\\'; }

/// Quoted and escaped; bytes that are not UTF-8 become U+FFFD, so that the text stays JSON whatever comes.
void append_string(std::string& out, std::string_view text);

/// \uXXXX, or two of them. REQUIRES a code point.
void append_code(std::string& out, char32_t code);

/// The same JSON for a terminal: what stands in its strings and is not printable (core/printable.h) as
/// \uXXXX. REQUIRES valid JSON.
std::string printable_json(std::string_view json);

/// Foreign text as an error cites it: printable (core/printable.h), the first max_bytes, "..." for the rest.
std::string shown(std::string_view text, std::size_t max_bytes = 64);

}  // namespace woodlouse::json
