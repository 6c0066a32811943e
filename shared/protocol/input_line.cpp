#include "shared/protocol/input_line.h"

#include <charconv>
#include <cstdint>
#include <string_view>

#include "shared/protocol/field_reader.h"
#include "shared/state/thrust.h"

namespace woodlouse::protocol {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes tokens off the front of a line; whoever is refused one gives the line up.
class Scanner {
 public:
  explicit Scanner(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

  bool take(char c) {
    skip_blanks();
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }

  /// The text between quotes, if it has neither quotes nor escapes.
  std::optional<std::string_view> text() {
    if (!take('"')) return std::nullopt;
    const char* const begin = at_;
    while (at_ != end_ && *at_ >= 'a' && *at_ <= 'z') ++at_;
    if (at_ == end_ || *at_ != '"') return std::nullopt;
    return std::string_view(begin, static_cast<std::size_t>(at_++ - begin));
  }

  std::optional<std::int64_t> integer(IntegerRange range) {
    skip_blanks();
    constexpr std::ptrdiff_t kMaxDigits = 15;
    const char* const begin = at_;
    std::int64_t value = 0;
    for (; at_ != end_ && is_digit(*at_) && at_ - begin <= kMaxDigits; ++at_)
      value = 10 * value + (*at_ - '0');
    const bool is_whole = at_ != begin && at_ - begin <= kMaxDigits && (*begin != '0' || at_ - begin == 1);
    if (!is_whole || value < range.low || value > range.high) return std::nullopt;
    return value;  // what else a number could go on with is no comma and no brace
  }

  std::optional<double> number() {
    skip_blanks();
    const char* const begin = at_;
    if (at_ != end_ && *at_ == '-') ++at_;
    const char* const whole = at_;
    if (!digits() || (*whole == '0' && at_ - whole > 1)) return std::nullopt;
    if (at_ != end_ && *at_ == '.') {
      ++at_;
      if (!digits()) return std::nullopt;
    }
    double value = 0.0;
    const auto read = std::from_chars(begin, at_, value);
    return read.ec == std::errc() && read.ptr == at_ ? std::optional(value) : std::nullopt;
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
  void skip_blanks() {
    while (at_ != end_ && *at_ == ' ') ++at_;
  }
  bool digits() {
    const char* const begin = at_;
    while (at_ != end_ && is_digit(*at_)) ++at_;
    return at_ != begin;
  }

  const char* at_;
  const char* end_;
};

std::optional<state::RoundedThrust> scan_thrust(Scanner& scanner) {
  if (!scanner.is_at('[')) {
    const auto value = scanner.number();
    return value ? std::optional(state::rounded_along_heading(*value)) : std::nullopt;
  }
  scanner.take('[');
  const auto x = scanner.number();
  if (!x || !scanner.take(',')) return std::nullopt;
  const auto y = scanner.number();
  if (!y || !scanner.take(']')) return std::nullopt;
  return state::rounded_map_vector({*x, *y});
}

/// Takes an integer into a field that is still free.
template <typename T>
bool scan_once(Scanner& scanner, std::optional<T>& field, IntegerRange range) {
  if (field) return false;
  const auto value = scanner.integer(range);
  if (value) field = static_cast<T>(*value);
  return value.has_value();
}

}  // namespace

std::optional<Input> scan_input(std::string_view line) {
  Scanner scanner(line);
  bool has_type = false;
  std::optional<std::uint32_t> seq;
  std::optional<state::RoundedThrust> thrust;
  Input input;
  const auto scan_member = [&] {
    const auto key = scanner.text();
    if (!key || !scanner.take(':')) return false;
    if (*key == "seq") return scan_once(scanner, seq, kAnyUint32);
    if (*key == "tick") return scan_once(scanner, input.tick, kAnyTick);
    if (*key == "ticks") return scan_once(scanner, input.ticks, {1, kMaxThrustTicks});
    if (*key == "thrust" && !thrust) return (thrust = scan_thrust(scanner)).has_value();
    if (*key != "type" || has_type) return false;
    const auto type = scanner.text();
    return has_type = type && *type == "input";
  };
  if (!scanner.take('{')) return std::nullopt;
  do {
    if (!scan_member()) return std::nullopt;
  } while (scanner.take(','));
  if (!scanner.take('}') || !scanner.is_at_end() || !has_type || !seq || !thrust) return std::nullopt;
  input.seq = *seq;
  input.thrust = thrust->thrust;
  input.clamped = thrust->clamped;
  return input;
}

}  // namespace woodlouse::protocol
