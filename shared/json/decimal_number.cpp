#include "shared/json/decimal_number.h"

#include <cassert>
#include <cmath>

#ifndef __cpp_lib_to_chars
#define FMT_HEADER_ONLY 1
#define FMT_USE_FULL_CACHE_DRAGONBOX 0  // small tables
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>
#endif

namespace woodlouse::json {

#ifdef __cpp_lib_to_chars
char* write_shortest(char* to, double value) {
  assert(std::isfinite(value));
  return std::to_chars(to, to + kShortestRoom, value).ptr;
}
#else
namespace {

char* write(char* to, std::string_view text) { return std::copy(text.begin(), text.end(), to); }

/// value, whole and below 10^22, exactly.
char* write_whole(char* to, double value) {
  __extension__ using Wide = unsigned __int128;
  Wide rest = static_cast<Wide>(value);
  char digits[32];
  char* begin = std::end(digits);
  do {
    *--begin = static_cast<char>('0' + static_cast<int>(rest % 10));
    rest /= 10;
  } while (rest != 0);
  return std::copy(begin, std::end(digits), to);
}

}  // namespace

/// fast_float gives an infinity or zero where no double is near; then `value` is to stay as it was.
std::from_chars_result read_decimal(const char* first, const char* last, double& value) {
  double nearest = 0.0;
  const auto [end, error] = fast_float::from_chars(first, last, nearest);
  if (error != std::errc{}) return {end, error};
  if (nearest != 0.0 && !std::isinf(nearest)) {
    value = nearest;
    return {end, error};
  }
  std::string_view digits(first, static_cast<std::size_t>(end - first));
  if (digits.starts_with('-')) digits.remove_prefix(1);
  const bool is_written_in_digits = digits.front() == '.' || (digits.front() >= '0' && digits.front() <= '9');
  const std::string_view mantissa = digits.substr(0, digits.find_first_of("eE"));
  const bool is_too_large = std::isinf(nearest) && is_written_in_digits;
  const bool is_too_small = nearest == 0.0 && mantissa.find_first_of("123456789") != std::string_view::npos;
  if (is_too_large || is_too_small) return {end, std::errc::result_out_of_range};
  value = nearest;
  return {end, error};
}

/// As std::to_chars has it: the shortest digits, laid out as a fixed or a scientific number, whichever is
/// shorter, and of both as long the fixed one.
char* write_shortest(char* to, double value) {
  assert(std::isfinite(value));
  if (std::signbit(value)) *to++ = '-';
  const double size = std::abs(value);
  if (size == 0.0) return write(to, "0");
  const auto [significand, exponent] = fmt::detail::dragonbox::to_decimal(size);
  char buffer[20];
  const char* const end = std::to_chars(buffer, std::end(buffer), significand).ptr;
  const std::string_view digits(buffer, static_cast<std::size_t>(end - buffer));
  const auto count = static_cast<int>(digits.size());
  const bool is_fixed = exponent <= (count == 1 ? 4 : 5) && exponent >= (count == 1 ? -3 : -(count + 3));
  if (is_fixed && exponent >= 0) return write_whole(to, size);
  if (is_fixed) {
    const int whole = count + exponent;  // digits before the point
    if (whole > 0) {
      to = write(to, digits.substr(0, static_cast<std::size_t>(whole)));
      *to++ = '.';
      return write(to, digits.substr(static_cast<std::size_t>(whole)));
    }
    to = write(to, "0.");
    to = std::fill_n(to, -whole, '0');
    return write(to, digits);
  }
  *to++ = digits.front();
  if (count > 1) {
    *to++ = '.';
    to = write(to, digits.substr(1));
  }
  *to++ = 'e';
  const int power = exponent + count - 1;
  *to++ = power < 0 ? '-' : '+';
  const int shown = std::abs(power);
  if (shown < 10) *to++ = '0';
  return std::to_chars(to, to + 3, shown).ptr;
}
#endif

}  // namespace woodlouse::json
