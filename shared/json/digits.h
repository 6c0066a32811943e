// The digits of a whole number without a branch on how many there are: rows of random numbers spend their
// time in mispredicted branches, not in arithmetic.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace woodlouse::json {

inline constexpr std::uint64_t kDigitsBelow = 100'000'000;

/// Its eight digits, the first of them in the lowest byte. REQUIRES value < kDigitsBelow.
inline std::uint64_t digit_lanes(std::uint32_t value) {
  static_assert(std::endian::native == std::endian::little, "the first digit is the lowest byte");
  // Halves are split side by side in lanes of one word: 2 x 4 digits, 4 x 2, 8 x 1. The factors are the
  // reciprocals of 100 and 10, near enough for what a lane can hold.
  std::uint64_t lanes = value / 10'000u | static_cast<std::uint64_t>(value % 10'000u) << 32;
  const std::uint64_t hundreds = ((lanes * 10'486) >> 20) & 0x0000'007f'0000'007f;
  lanes = hundreds | (lanes - hundreds * 100) << 16;
  const std::uint64_t tens = ((lanes * 103) >> 10) & 0x000f'000f'000f'000f;
  return tens | (lanes - tens * 10) << 8;
}

/// Writes eight bytes at `to`, the first of them the digits without leading zeros; returns their end.
/// REQUIRES value < kDigitsBelow.
inline char* write_digits(char* to, std::uint32_t value) {
  const std::uint64_t lanes = digit_lanes(value);
  constexpr std::uint64_t kLastDigit = std::uint64_t{1} << 56;  // is written even if it is 0
  const int leading_zeros = std::countr_zero(lanes | kLastDigit) / 8;
  const std::uint64_t text = (lanes + 0x3030'3030'3030'3030) >> (8 * leading_zeros);
  std::memcpy(to, &text, sizeof text);
  return to + (8 - leading_zeros);
}

}  // namespace woodlouse::json
