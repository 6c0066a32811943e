// What the numbers of a command line may be. CLI11's own conversion takes -1 for 2^64 - 1, and its texts say
// ranges to 300 digits.
#pragma once

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

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
inline CLI::Validator seconds() {
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

}  // namespace woodlouse::server
