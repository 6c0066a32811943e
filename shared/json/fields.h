// What a field may be, checked in one place. Two kinds of reader say what was wrong: Fields and Problems
// below, for files, collect every problem with its line and go on with a fallback, so that one run tells all;
// the wire's (protocol/field_reader.h) keeps the first fault and its code. Both ask the checks here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/error.h"
#include "shared/core/vec2.h"
#include "shared/json/document.h"

namespace woodlouse::json {

// ---- checks: the value, or nothing where it is none of that kind and range
// ------------------------------------

/// 16 lower-case hex digits in quotes.
std::optional<std::uint64_t> hash_of(const Value& value);
/// Two numbers.
std::optional<core::Vec2> pair_of(const Value& value);
/// A whole number of that range.
std::optional<std::int64_t> integer_of(const Value& value, std::int64_t low, std::int64_t high);
/// A text that from_text(std::string_view) knows; it gives an optional.
template <typename FromText>
auto choice_of(const Value& value, const FromText& from_text) -> decltype(from_text(std::string_view())) {
  if (!value.is(Kind::kString)) return std::nullopt;
  return from_text(value.text());
}
/// A whole text as an unsigned number of that base.
std::optional<std::uint64_t> unsigned_text(std::string_view text, int base);

// ---- every problem, with its line
// -------------------------------------------------------------------------------

/// What is wrong with one source; the first kMaxProblems, so that a file of garbage stays readable, and how
/// many more there are.
class Problems {
 public:
  static constexpr std::size_t kMaxProblems = 100;

  explicit Problems(std::string source) : source_(std::move(source)) {}

  /// where = "source:line: field"; line 0 and an empty field are left out.
  void add(std::size_t line, std::string_view field, std::string what, std::string hint = {});
  void add(const Value& value, std::string what, std::string hint = {});
  void add(core::Error error);

  [[nodiscard]] bool is_full() const { return errors_.size() >= kMaxProblems; }
  [[nodiscard]] std::size_t count() const { return errors_.size(); }
  [[nodiscard]] std::vector<core::Error>& errors() { return errors_; }
  /// What was added when it was full.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  /// So many more that nobody puts into words.
  void leave_out(std::size_t count) { left_out_ += count; }
  /// Those of `other`, which is of a file that this source names.
  void take_over(Problems&& other);
  /// The errors, and in the last line how many were left out.
  [[nodiscard]] std::vector<core::Error> told() &&;
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  std::string source_;
  std::vector<core::Error> errors_;
  std::size_t left_out_ = 0;
};

/// A closed range and its unit, for checks and for their message.
struct Range {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  std::string_view unit;  ///< as in "m/s^2"; empty: none
};

/// The value as a number in range; reports and gives nothing otherwise.
std::optional<double> number_in(const Value& value, const Range& range, Problems& problems);
/// The same for two of them, [x, y].
std::optional<core::Vec2> pair_in(const Value& value, const Range& range, Problems& problems);
std::optional<std::uint64_t> integer_in(const Value& value, std::uint64_t min, std::uint64_t max,
                                        Problems& problems);
/// Text of min..max bytes without control characters.
std::optional<std::string> text_in(const Value& value, std::size_t min, std::size_t max, Problems& problems);

/// Text of at most that many bytes, otherwise as it was said.
std::string any_text(const Value& value, std::size_t max, Problems& problems);

/// The members of an object. Reports unknown ones at once, with the known one that looks most alike.
class Fields {
 public:
  Fields(const Value& object, std::initializer_list<std::string_view> known, Problems& problems);
  /// Of what a newer build may say more in: unknown ones are passed over.
  Fields(const Value& object, Problems& problems);

  /// The member, or nothing when it is left out.
  [[nodiscard]] std::optional<Value> find(std::string_view key) const { return object_.find(key); }
  /// The member; reports when it is left out.
  [[nodiscard]] std::optional<Value> demand(std::string_view key, std::string_view hint = {}) const;
  /// A number that may be left out.
  [[nodiscard]] double number_or(std::string_view key, const Range& range, double fallback) const;

  // Those that must be there; what is missing or wrong is reported, and the least value or nothing given.
  [[nodiscard]] std::uint64_t integer(std::string_view key, std::uint64_t min, std::uint64_t max) const;
  [[nodiscard]] std::uint64_t hash(std::string_view key) const;
  [[nodiscard]] std::string text(std::string_view key, std::size_t max) const;

 private:
  Value object_;
  Problems& problems_;
};

/// ` (did you mean "drag"?)`'s inside, for the candidate nearest to `text`; empty when none is near.
std::string did_you_mean(std::string_view text, std::initializer_list<std::string_view> candidates);

}  // namespace woodlouse::json
