// Tokens off the front of a line of JSON whose form is known: for the few kinds of lines that come by the
// million. Whatever is unusual is refused, and left to the document's parser (document.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shared/json/decimal_number.h"

namespace woodlouse::json {

/// Whoever is refused a token gives the line up. Blanks before one are passed over. Loops walk a copy of the
/// place, which stays in a register.
class Scanner {
 public:
  explicit Scanner(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

  bool take(char c) {
    if (!is_at(c)) return false;
    ++at_;
    return true;
  }

  /// The text between quotes, if it has neither quotes nor escapes.
  std::optional<std::string_view> text() {
    if (!take('"')) return std::nullopt;
    const char* at = at_;
    while (at != end_ && *at >= 'a' && *at <= 'z') ++at;
    if (at == end_ || *at != '"') return std::nullopt;
    const std::string_view text(at_, static_cast<std::size_t>(at - at_));
    at_ = at + 1;
    return text;
  }

  /// Of at most 15 digits; minus zero is none.
  std::optional<std::int64_t> integer(std::int64_t low, std::int64_t high) {
    skip_blanks();
    const bool is_negative = at_ != end_ && *at_ == '-';
    if (is_negative) ++at_;
    const Digits digits = take_digits(0);
    const bool is_whole = digits.count != 0 && digits.count <= kMaxDigits && !digits.has_leading_zero;
    if (!is_whole || (is_negative && digits.value == 0)) return std::nullopt;
    const auto size = static_cast<std::int64_t>(digits.value);
    const std::int64_t value = is_negative ? -size : size;
    if (value < low || value > high) return std::nullopt;
    return value;  // what else a number could go on with is no comma and no brace
  }

  std::optional<double> number() {
    skip_blanks();
    const char* const begin = at_;
    const bool is_negative = at_ != end_ && *at_ == '-';
    if (is_negative) ++at_;
    const Digits whole = take_digits(0);
    if (whole.count == 0 || whole.has_leading_zero) return std::nullopt;
    Digits all = whole;
    if (at_ != end_ && *at_ == '.') {
      ++at_;
      all = take_digits(whole.value);
      if (all.count == 0) return std::nullopt;
      all.count += whole.count;
    }
    if (all.count <= kMaxDigits) {
      // A whole number and a power of ten that both are doubles: their quotient is the nearest one.
      const double size = static_cast<double>(all.value) / kPowersOfTen[all.count - whole.count];
      return is_negative ? -size : size;
    }
    double value = 0.0;
    const auto read = read_decimal(begin, at_, value);
    return read.ec == std::errc() && read.ptr == at_ ? std::optional(value) : std::nullopt;
  }

  /// 16 lower-case hex digits between quotes.
  std::optional<std::uint64_t> hash() {
    constexpr std::ptrdiff_t kDigits = 16;
    if (!take('"') || end_ - at_ <= kDigits || at_[kDigits] != '"') return std::nullopt;
    std::uint64_t value = 0;
    for (const char* at = at_; at != at_ + kDigits; ++at) {
      const bool is_letter = *at >= 'a' && *at <= 'f';
      if (!is_letter && !is_digit(*at)) return std::nullopt;
      value = value << 4 | static_cast<std::uint64_t>(is_letter ? *at - 'a' + 10 : *at - '0');
    }
    at_ += kDigits + 1;
    return value;
  }

  bool take_null() {
    constexpr std::string_view kNull = "null";
    skip_blanks();
    if (!std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(kNull)) return false;
    at_ += kNull.size();
    return true;
  }

  bool is_at(char c) {
    skip_blanks();
    return at_ != end_ && *at_ == c;
  }

  bool is_at_end() {
    skip_blanks();
    return at_ == end_ || (*at_ == '\n' && at_ + 1 == end_);
  }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  struct Digits {
    std::uint64_t value = 0;  ///< right while there are kMaxDigits at most
    std::size_t count = 0;
    bool has_leading_zero = false;  ///< before another digit
  };
  static constexpr std::size_t kMaxDigits = 15;
  static constexpr double kPowersOfTen[kMaxDigits + 1] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                          1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

  void skip_blanks() {
    const char* at = at_;
    while (at != end_ && *at == ' ') ++at;
    at_ = at;
  }
  /// All there are; `before`: the value of those that stand before them.
  Digits take_digits(std::uint64_t before) {
    const char* at = at_;
    std::uint64_t value = before;
    for (; at != end_ && is_digit(*at); ++at) value = 10 * value + static_cast<std::uint64_t>(*at - '0');
    const auto count = static_cast<std::size_t>(at - at_);
    const bool has_leading_zero = count > 1 && *at_ == '0';
    at_ = at;
    return {value, count, has_leading_zero};
  }

  const char* at_;
  const char* end_;
};

}  // namespace woodlouse::json
