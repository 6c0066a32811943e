// The shortest decimal of a fraction, found in whole numbers alone: a double above 2^-8 times the power of
// ten that it takes fits into 128 bits, so that nothing is approximated and no table of powers is needed.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "shared/json/digits.h"

namespace woodlouse::json {

/// digits / 10^places
struct Decimal {
  std::uint64_t digits = 0;  ///< below 10^17; may end in zeros
  int places = 0;            ///< 1 to 19
};

/// shortest_decimal() and write_decimal() are for these: a fraction whose size is 2^-8 at least.
inline bool has_decimal(double value) {
  return std::abs(value) >= 0x1p-8 && std::abs(value) < 0x1p52 && std::trunc(value) != value;
}

/// Of the decimals that read back as |value| those of the fewest digits, of these the nearest (of two as
/// near, the even one), as std::to_chars chooses. REQUIRES has_decimal(value).
inline Decimal shortest_decimal(double value) {
  constexpr std::array<std::uint64_t, 20> kPowersOfTen = [] {
    std::array<std::uint64_t, 20> powers{1};
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = 10 * powers[k - 1];
    return powers;
  }();
  __extension__ using Wide = unsigned __int128;

  // |value| is mantissa / 2^shift, shift 1 to 60.
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t mantissa = (bits & 0xf'ffff'ffff'ffff) | 0x10'0000'0000'0000;
  const int shift = 1075 - static_cast<int>((bits >> 52) & 0x7ff);
  // The least power of ten that makes the doubles' spacing one or more: shift * log10(2), rounded up.
  const int places = (shift * 1233 + 4095) >> 12;
  const std::uint64_t spacing = kPowersOfTen[static_cast<std::size_t>(places)];  // in units of 2^-shift
  // What is nearer than half of the spacing reads back as the value; what is as near does to an even
  // mantissa. (Below a power of two the doubles are closer, but those from 2^-8 on are found exactly.)
  const std::uint64_t reach = spacing / 2 - (mantissa & 1);
  const Wide scaled = static_cast<Wide>(mantissa) * spacing;
  const auto whole = static_cast<std::uint64_t>(scaled >> shift);
  const std::uint64_t rest = static_cast<std::uint64_t>(scaled) & ((std::uint64_t{1} << shift) - 1);

  // The spacing is below ten: at most one multiple of ten is in reach.
  const std::uint64_t tens = whole / 10;
  const std::uint64_t above_tens = ((whole - 10 * tens) << shift) + rest;
  const std::uint64_t below_next = (std::uint64_t{10} << shift) - above_tens;
  if (above_tens <= reach) return {tens, places - 1};
  if (below_next <= reach) return {tens + 1, places - 1};
  const std::uint64_t half = std::uint64_t{1} << (shift - 1);
  const bool goes_up = rest > half || (rest == half && (whole & 1) != 0);
  return {whole + (goes_up ? 1 : 0), places};
}

/// Writes a decimal with a point and without closing zeros; returns the end. REQUIRES that it is not whole,
/// and room for 32 bytes at `to`, of which those past the end may be written too.
inline char* write_decimal(char* to, Decimal decimal) {
  constexpr std::uint64_t kZeros = 0x3030'3030'3030'3030;
  constexpr int kDigits = 24;
  const std::uint64_t upper = decimal.digits / kDigitsBelow;
  const std::uint64_t lanes[] = {upper / kDigitsBelow << 56,
                                 digit_lanes(static_cast<std::uint32_t>(upper % kDigitsBelow)),
                                 digit_lanes(static_cast<std::uint32_t>(decimal.digits % kDigitsBelow))};
  char digits[2 * kDigits];
  for (int k = 0; k < 3; ++k) {
    const std::uint64_t text = lanes[k] + kZeros;
    std::memcpy(digits + 8 * k, &text, sizeof text);
  }
  const int leading = lanes[0] != 0   ? 7
                      : lanes[1] != 0 ? 8 + std::countr_zero(lanes[1]) / 8
                                      : 16 + std::countr_zero(lanes[2]) / 8;
  const int end = lanes[2] != 0   ? kDigits - std::countl_zero(lanes[2]) / 8
                  : lanes[1] != 0 ? 16 - std::countl_zero(lanes[1]) / 8
                                  : 8;
  const int point = kDigits - decimal.places;
  const int begin = leading < point ? leading : point - 1;  // one digit before the point
  std::memcpy(to, digits + begin, 16);
  to += point - begin;
  *to++ = '.';
  std::memcpy(to, digits + point, 16);
  if (end - point > 16) std::memcpy(to + 16, digits + point + 16, 8);
  return to + (end - point);
}

}  // namespace woodlouse::json
