// What the numbers of a command line may be, with a unit or without. CLI11's own conversion takes -1 for 2^64
// - 1, and its texts say ranges to 300 digits.
#pragma once

#include <CLI/CLI.hpp>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::server {

/// Digits alone, and from `least` to `most`.
inline CLI::Validator whole_number(std::uint64_t least, std::uint64_t most = UINT64_MAX) {
  const std::string range = most == UINT64_MAX
                                ? "from " + std::to_string(least) + " on"
                                : "from " + std::to_string(least) + " to " + std::to_string(most);
  return {[=](std::string& text) {
            std::uint64_t number = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool is_good =
                error == std::errc() && end == text.data() + text.size() && number >= least && number <= most;
            return is_good ? std::string() : "a whole number " + range + " is wanted, not " + text;
          },
          range};
}

/// A finite number, 0 or more.
inline CLI::Validator number_of_seconds() {
  return {[](std::string& text) {
            double number = 0.0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool is_good = error == std::errc() && end == text.data() + text.size() &&
                                 std::isfinite(number) && number >= 0.0;
            return is_good ? std::string() : "seconds, 0 or more, are wanted, not " + text;
          },
          "seconds"};
}

/// A finite number from `least` to `most`, which are named by `range`. CLI11's own range lets nan through.
inline CLI::Validator number_within(double least, double most, std::string range) {
  return {[least, most, range](std::string& text) {
            double number = 0.0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool is_good =
                error == std::errc() && end == text.data() + text.size() && number >= least && number <= most;
            return is_good ? std::string() : "a number " + range + " is wanted, not " + text;
          },
          range};
}

/// 90m: digits and s, m, h or d. Errors: where = `option` and `text`; less than `least`, more than 10000 d.
core::Expected<std::chrono::seconds> parse_duration(const std::string& option, const std::string& text,
                                                    std::chrono::seconds least);

/// 10G: digits, and K, M, G or T for powers of 1024, bytes without. Errors: where = `option` and `text`; 0,
/// or more than 64 bits.
core::Expected<std::uint64_t> parse_bytes(const std::string& option, const std::string& text);

}  // namespace woodlouse::server
