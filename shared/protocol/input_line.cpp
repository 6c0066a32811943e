#include "shared/protocol/input_line.h"

#include <charconv>
#include <cstdint>
#include <string_view>

#include "shared/protocol/field_reader.h"
#include "shared/state/thrust.h"

namespace woodlouse::protocol {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes tokens off the front of a line; whoever is refused one gives the line up. Loops walk a copy of the
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

  std::optional<std::int64_t> integer(IntegerRange range) {
    skip_blanks();
    const Digits digits = take_digits(0);
    const bool is_whole = digits.count != 0 && digits.count <= kMaxDigits && !digits.has_leading_zero;
    const auto value = static_cast<std::int64_t>(digits.value);
    if (!is_whole || value < range.low || value > range.high) return std::nullopt;
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
