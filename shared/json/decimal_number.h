// The double nearest to a decimal text, as std::from_chars gives it: no locale, no allocation.
#pragma once

#include <charconv>

#ifndef __cpp_lib_to_chars  // libc++ before 20 reads no floating point
#include <fast_float/fast_float.h>

#include <cmath>
#include <string_view>
#include <system_error>
#endif

namespace woodlouse::json {

#ifdef __cpp_lib_to_chars
inline std::from_chars_result read_decimal(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}
#else
/// fast_float gives an infinity or zero where no double is near; then `value` is to stay as it was.
inline std::from_chars_result read_decimal(const char* first, const char* last, double& value) {
  double nearest = 0.0;
  const auto [end, error] = fast_float::from_chars(first, last, nearest);
  if (error != std::errc{}) return {end, error};
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
#endif

}  // namespace woodlouse::json
