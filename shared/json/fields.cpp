#include "shared/json/fields.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <numeric>
#include <system_error>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/printable.h"
#include "shared/core/utf8.h"
#include "shared/json/text.h"

namespace woodlouse::json {
namespace {

/// Insertions, deletions and replacements between two words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// REQUIRES UTF-8.
bool has_control(std::string_view text) {
  for (; !text.empty(); text.remove_prefix(core::first_character(text).size)) {
    if (core::is_control(core::first_character(text).code)) return true;
  }
  return false;
}

std::string expected(std::string_view wanted, const Value& value) {
  return core::joined({wanted, " is wanted, not ", to_text(value.kind())});
}

}  // namespace

std::optional<std::uint64_t> unsigned_text(std::string_view text, int base) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> hash_of(const Value& value) {
  const std::string_view text = value.is(Kind::kString) ? value.text() : std::string_view();
  const bool is_hash =
      text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
  return is_hash ? unsigned_text(text, 16) : std::nullopt;
}

std::optional<core::Vec2> pair_of(const Value& value) {
  if (!value.is(Kind::kArray) || value.size() != 2) return std::nullopt;
  const std::vector<Value> elements = value.children();
  if (!elements[0].is_number() || !elements[1].is_number()) return std::nullopt;
  return core::Vec2{elements[0].number(), elements[1].number()};
}

std::optional<std::int64_t> integer_of(const Value& value, std::int64_t low, std::int64_t high) {
  assert(low <= high);
  const std::optional<std::int64_t> number = value.integer();
  return number && *number >= low && *number <= high ? number : std::nullopt;
}

void Problems::add(std::size_t line, std::string_view field, std::string what, std::string hint) {
  std::string where = source_;
  if (line != 0) where.append(":").append(std::to_string(line));
  if (!field.empty()) where.append(": ").append(field);
  add(core::Error{std::move(where), std::move(what), std::move(hint)});
}

void Problems::add(const Value& value, std::string what, std::string hint) {
  if (is_full()) return leave_out(1);  // a line and a path cost a walk through the text
  add(value.line(), value.path(), std::move(what), std::move(hint));
}

void Problems::add(core::Error error) {
  if (is_full()) return leave_out(1);
  errors_.push_back(std::move(error));
}

void Problems::take_over(Problems&& other) {
  for (core::Error& error : other.errors_) add(std::move(error));
  leave_out(other.left_out_);
}

std::vector<core::Error> Problems::told() && {
  if (left_out_ != 0)
    errors_.emplace_back(source_, core::joined({"and ", std::to_string(left_out_), " more"}));
  return std::move(errors_);
}

std::optional<double> number_in(const Value& value, const Range& range, Problems& problems) {
  if (!value.is_number()) {
    problems.add(value, expected("a number", value));
    return std::nullopt;
  }
  const double number = value.number();
  if (number >= range.min && number <= range.max) return number;
  const std::string unit = range.unit.empty() ? std::string() : core::joined({" ", range.unit});
  problems.add(value, core::joined({double_text(number), unit, " is out of range"}),
               core::joined({double_text(range.min), " to ", double_text(range.max), unit}));
  return std::nullopt;
}

std::optional<core::Vec2> pair_in(const Value& value, const Range& range, Problems& problems) {
  const std::vector<Value> elements = value.children();
  if (!value.is(Kind::kArray) || elements.size() != 2) {
    problems.add(value, "a pair [x, y] is wanted");
    return std::nullopt;
  }
  const std::optional<double> x = number_in(elements[0], range, problems);
  const std::optional<double> y = number_in(elements[1], range, problems);
  if (!x || !y) return std::nullopt;
  return core::Vec2{*x, *y};
}

std::optional<std::uint64_t> integer_in(const Value& value, std::uint64_t min, std::uint64_t max,
                                        Problems& problems) {
  const std::optional<std::uint64_t> number = value.unsigned_integer();
  if (number && *number >= min && *number <= max) return number;
  problems.add(
      value,
      number ? core::joined({std::to_string(*number), " is out of range"}) : "a whole number is wanted",
      core::joined({std::to_string(min), " to ", std::to_string(max)}));
  return std::nullopt;
}

std::optional<std::string> text_in(const Value& value, std::size_t min, std::size_t max, Problems& problems) {
  if (!value.is(Kind::kString)) {
    problems.add(value, expected("text", value));
    return std::nullopt;
  }
  const std::string_view text = value.text();
  if (text.size() < min || text.size() > max) {
    problems.add(value, core::joined({"text of ", std::to_string(text.size()), " bytes"}),
                 core::joined({std::to_string(min), " to ", std::to_string(max), " bytes"}));
    return std::nullopt;
  }
  if (has_control(text)) {
    problems.add(value, "text with control characters", "leave them out");
    return std::nullopt;
  }
  return std::string(text);
}

std::string any_text(const Value& value, std::size_t max, Problems& problems) {
  if (value.is(Kind::kString) && value.text().size() <= max) return std::string(value.text());
  problems.add(value, core::joined({"text of at most ", std::to_string(max), " bytes is wanted"}));
  return {};
}

std::string did_you_mean(std::string_view text, std::initializer_list<std::string_view> candidates) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, text.size() / 3) + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(text.substr(0, 64), candidate);
    if (distance < best_distance && distance < candidate.size()) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best.empty() ? std::string() : core::joined({"did you mean \"", best, "\"?"});
}

Fields::Fields(const Value& object, Problems& problems) : object_(object), problems_(problems) {
  if (!object.is(Kind::kObject)) problems.add(object, expected("an object", object));
}

Fields::Fields(const Value& object, std::initializer_list<std::string_view> known, Problems& problems)
    : Fields(object, problems) {
  if (!object.is(Kind::kObject)) return;
  for (const Value& member : object.children()) {
    if (std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
    if (problems.is_full()) {  // a suggestion costs more than its key
      problems.leave_out(1);
      continue;
    }
    std::string hint = did_you_mean(member.key(), known);
    if (hint.empty()) {
      hint = "known here:";
      for (const std::string_view key : known) hint.append(" ").append(key);
    }
    problems.add(member, "is not known", std::move(hint));
  }
}

std::optional<Value> Fields::demand(std::string_view key, std::string_view hint) const {
  std::optional<Value> value = object_.find(key);
  if (!value && object_.is(Kind::kObject)) {
    problems_.add(object_, core::joined({"\"", key, "\" is missing"}), std::string(hint));
  }
  return value;
}

std::uint64_t Fields::integer(std::string_view key, std::uint64_t min, std::uint64_t max) const {
  const std::optional<Value> value = demand(key);
  return value ? integer_in(*value, min, max, problems_).value_or(min) : min;
}

std::uint64_t Fields::hash(std::string_view key) const {
  const std::optional<Value> value = demand(key);
  if (!value) return 0;
  const std::optional<std::uint64_t> hash = hash_of(*value);
  if (!hash) problems_.add(*value, "16 lower-case hex digits are wanted");
  return hash.value_or(0);
}

std::string Fields::text(std::string_view key, std::size_t max) const {
  const std::optional<Value> value = demand(key);
  return value ? any_text(*value, max, problems_) : std::string();
}

double Fields::number_or(std::string_view key, const Range& range, double fallback) const {
  const std::optional<Value> value = find(key);
  return value ? number_in(*value, range, problems_).value_or(fallback) : fallback;
}

}  // namespace woodlouse::json
