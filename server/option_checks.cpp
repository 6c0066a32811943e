#include "server/option_checks.h"

#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace woodlouse::server {
namespace {

struct Quantity {
  std::uint64_t number = 0;
  std::string_view unit;  ///< what stands behind the digits
};

std::optional<Quantity> quantity(const std::string& text) {
  Quantity result;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, result.number);
  if (error != std::errc()) return std::nullopt;
  result.unit = {end, static_cast<std::size_t>(last - end)};
  return result;
}

/// Nothing: more than `most`.
std::optional<std::uint64_t> times(std::uint64_t number, std::uint64_t unit, std::uint64_t most) {
  if (number > most / unit) return std::nullopt;
  return number * unit;
}

std::optional<std::uint64_t> seconds_of(const std::string& text) {
  constexpr std::uint64_t kMinute = 60, kHour = 60 * kMinute, kDay = 24 * kHour, kMost = 10'000 * kDay;
  const auto typed = quantity(text);
  if (!typed) return std::nullopt;
  if (typed->unit == "s") return times(typed->number, 1, kMost);
  if (typed->unit == "m") return times(typed->number, kMinute, kMost);
  if (typed->unit == "h") return times(typed->number, kHour, kMost);
  if (typed->unit == "d") return times(typed->number, kDay, kMost);
  return std::nullopt;
}

std::optional<std::uint64_t> bytes_of(const std::string& text) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  constexpr std::string_view kUnits = "KMGT";
  const auto typed = quantity(text);
  if (!typed || typed->unit.size() > 1) return std::nullopt;
  if (typed->unit.empty()) return typed->number;
  const std::size_t power = kUnits.find(typed->unit);
  if (power == std::string_view::npos) return std::nullopt;
  return times(typed->number, std::uint64_t{1} << (10 * (power + 1)), kMost);
}

}  // namespace

core::Expected<std::chrono::seconds> parse_duration(const std::string& option, const std::string& text,
                                                    std::chrono::seconds least) {
  const auto number = seconds_of(text);
  if (!number)
    return core::fail(option + ' ' + text, "is no time",
                      "digits and s, m, h or d, at most 10000d; for example  " + option + " 1h");
  const std::chrono::seconds result(*number);
  if (result < least)
    return core::fail(option + ' ' + text, "is too short", "at least " + std::to_string(least.count()) + "s");
  return result;
}

core::Expected<std::uint64_t> parse_bytes(const std::string& option, const std::string& text) {
  const auto number = bytes_of(text);
  if (!number || *number == 0)
    return core::fail(
        option + ' ' + text, "is no size",
        "digits and K, M, G or T, powers of 1024, or bytes without, more than 0; for example  " + option +
            " 10G");
  return *number;
}

}  // namespace woodlouse::server
