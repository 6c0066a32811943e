// Doubles and decimal texts, as std::from_chars and std::to_chars have them, where they are: no locale, no
// allocation.
#pragma once

#include <charconv>

namespace woodlouse::json {

#ifdef __cpp_lib_to_chars
inline std::from_chars_result read_decimal(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}
#else  // libc++ before 20 reads no floating point
std::from_chars_result read_decimal(const char* first, const char* last, double& value);
#endif

inline constexpr int kShortestRoom = 32;
/// The shortest text that reads back as the same double, of these the nearest, in its shorter form; at `to`,
/// which has room for kShortestRoom. Returns the end. REQUIRES a finite value.
char* write_shortest(char* to, double value);

}  // namespace woodlouse::json
