// The words of a grid that is text: numbers and keys between white space, with the line they stand in.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "shared/core/joined.h"
#include "shared/json/decimal_number.h"
#include "shared/json/text.h"

namespace woodlouse::elevation {

struct Word {
  std::string_view text;  ///< empty: the text has ended
  std::size_t line = 0;   ///< from 1
};

/// Cuts the text at white space; counts lines. The text outlives it.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word without taking it; an empty one at the end.
  const Word& peek() {
    if (next_.text.empty()) advance();
    return next_;
  }
  Word take() {
    const Word word = peek();
    next_ = {};
    return word;
  }

 private:
  static bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\v';
  }

  void advance() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    next_ = {text_.substr(begin, at_ - begin), line_};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  Word next_;
};

/// The whole word as a number; infinities and NaN included.
inline std::optional<double> to_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = json::read_decimal(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// A word of the file within a message, cut to a readable length.
inline std::string quoted(std::string_view word) { return core::joined({"\"", json::shown(word, 32), "\""}); }

/// What to do about a word that is no number; empty: nobody knows.
inline std::string number_hint(std::string_view word) {
  return word.find(',') == std::string_view::npos
             ? std::string()
             : "the decimal sign is a point, not a comma: tr , . < FILE > NEW_FILE";
}

}  // namespace woodlouse::elevation
