#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/utf8.h"
#include "shared/json/document.h"

namespace woodlouse::json {
namespace {

/// Feeds nlohmann's parser and tells how far it has read.
struct CountedCharacter {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at = nullptr;
  const char** read_up_to = nullptr;

  reference operator*() const { return *at; }
  CountedCharacter& operator++() {
    *read_up_to = ++at;
    return *this;
  }
  CountedCharacter operator++(int) {
    CountedCharacter before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountedCharacter& a, const CountedCharacter& b) { return a.at == b.at; }
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_of_number(char c) { return is_digit(c) || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E'; }

/// `[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while ...; last read:
/// '...'` without what the error's place tells already, and without bytes that are not plain ASCII.
std::string without_place(std::string_view message) {
  if (const auto bracket = message.find("] "); bracket != std::string_view::npos)
    message.remove_prefix(bracket + 2);
  if (message.starts_with("parse error")) {
    if (const auto colon = message.find(": "); colon != std::string_view::npos)
      message.remove_prefix(colon + 2);
  }
  message = message.substr(0, message.find("; last read"));
  std::string plain;
  for (const char c : message) plain += c >= ' ' && c < 0x7f ? c : '?';
  return plain;
}

}  // namespace

/// Events of SAX made into a document: nlohmann's, which know everything that can be wrong with a text, and
/// read_plain()'s, which come many times as fast.
class Parser {
 public:
  Parser(std::string_view text, const Limits& limits) : limits_(limits), read_(text.data()) {
    document_.text_ = text;
  }

  tl::expected<Document, ParseError> parse() {
    const std::string_view text = document_.text_;
    if (text.size() > kMaxBytes)
      return tl::unexpected(ParseError{Fault::kTooLong, 0, "longer than 2 GiB", {}});
    // nlohmann takes a NUL for the end and would pass over what follows it.
    if (const auto nul = text.find('\0'); nul != std::string_view::npos) {
      return tl::unexpected(ParseError{Fault::kNotJson, nul, "a NUL byte; send text", {}});
    }
    if (read_plain()) return std::move(document_);
    begin_anew();
    const CountedCharacter first{text.data(), &read_};
    const CountedCharacter last{text.data() + text.size(), &read_};
    if (!nlohmann::json::sax_parse(first, last, this)) return tl::unexpected(std::move(error_));
    return std::move(document_);
  }

  bool null() { return word(Kind::kNull, 4); }
  bool boolean(bool value) { return word(Kind::kBoolean, value ? 4 : 5); }
  bool number_integer(std::int64_t) { return number(); }
  bool number_unsigned(std::uint64_t) { return number(); }
  bool number_float(double, const std::string&) { return number(); }
  bool string(std::string_view value) {
    if (!add(Kind::kString, last_read())) return false;
    const Characters characters = keep(value);
    document_.nodes_.back().members = characters.begin;
    document_.nodes_.back().size = characters.size;
    return true;
  }
  bool binary(nlohmann::json::binary_t&) { return false; }  // no JSON text has one
  bool start_object(std::size_t) { return open(Kind::kObject); }
  bool start_array(std::size_t) { return open(Kind::kArray); }
  bool end_object() { return close() && keys_are_distinct(); }
  bool end_array() { return close(); }
  bool key(std::string_view name) {
    key_ = keep(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string& last, const nlohmann::json::exception& error) {
    constexpr int kOutOfRange = 406;
    if (error.id != kOutOfRange) return fail(Fault::kNotJson, last_read(), without_place(error.what()));
    constexpr std::size_t kMaxShownBytes = 40;
    const std::string_view number = std::string_view(last).substr(0, kMaxShownBytes);
    return fail(Fault::kNotJson, last_read(),
                core::joined({"the number ", number, last.size() > kMaxShownBytes ? "..." : "",
                              " is too large for a double"}));
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// Bytes read so far; the parser looks one character past a number.
  [[nodiscard]] std::size_t read() const { return static_cast<std::size_t>(read_ - document_.text_.data()); }
  /// The offset of the last character read.
  [[nodiscard]] std::size_t last_read() const { return read() == 0 ? 0 : read() - 1; }

  // ---- text as programs write it --------------------------------------------------------------------------

  /// All of it; takes what nlohmann's parser would take, and makes the same document. False: something is
  /// wrong, or rare (an escape, a number that may be too large): that one is to look at it.
  bool read_plain() {
    do {
      if (!take_value()) return false;
      while (!open_.empty() && !take(',')) {
        if (!(is_in(Kind::kObject) ? take('}') && end_object() : take(']') && end_array())) return false;
      }
    } while (!open_.empty());
    return next() == '\0';
  }

  void begin_anew() {
    read_ = document_.text_.data();
    open_.clear();
    key_ = {};
    document_.nodes_.clear();
    document_.strings_.clear();
  }

  /// Down to one that has no members; where an object's is due, its key before it.
  bool take_value() {
    for (;;) {
      if (is_in(Kind::kObject)) {
        const auto name = take('"') ? take_plain_text() : std::nullopt;
        if (!name || !take(':')) return false;
        key(*name);
      }
      const char first = next();
      if (first != '{' && first != '[') return take_scalar(first);
      ++read_;
      if (!open(first == '{' ? Kind::kObject : Kind::kArray)) return false;
      if (next() == (first == '{' ? '}' : ']')) return true;  // is taken by who closes
    }
  }

  bool take_scalar(char first) {
    if (first == '"') {
      ++read_;
      const auto text = take_plain_text();
      return text && string(*text);
    }
    if (first == 't') return take_word("true") && boolean(true);
    if (first == 'f') return take_word("false") && boolean(false);
    if (first == 'n') return take_word("null") && null();
    return take_number();
  }

  /// Up to the closing quote.
  std::optional<std::string_view> take_plain_text() {
    const char* const begin = read_;
    const char* at = begin;
    for (; at != end() && *at != '"'; ++at) {
      const auto byte = static_cast<unsigned char>(*at);
      if (byte < 0x20 || byte == '\\') return std::nullopt;
      if (byte < 0x80) continue;
      const core::Utf8Character character = core::first_character({at, static_cast<std::size_t>(end() - at)});
      if (!character.valid) return std::nullopt;
      at += character.size - 1;
    }
    if (at == end()) return std::nullopt;
    read_ = at + 1;
    return std::string_view(begin, static_cast<std::size_t>(at - begin));
  }

  bool take_word(std::string_view word) {
    if (!std::string_view(read_, static_cast<std::size_t>(end() - read_)).starts_with(word)) return false;
    read_ += word.size();
    return true;
  }

  /// Refuses, too, what a double may not hold.
  bool take_number() {
    constexpr std::ptrdiff_t kMostCharacters = 200, kMostOfPower = 2;
    const char* const begin = read_;
    Kind kind = Kind::kInteger;
    if (here() == '-') ++read_;
    if (here() == '0') {
      ++read_;
      if (is_digit(here())) return false;
    } else if (take_digits() == 0) {
      return false;
    }
    if (here() == '.') {
      ++read_;
      if (take_digits() == 0) return false;
      kind = Kind::kFraction;
    }
    if (read_ - begin > kMostCharacters) return false;
    if (here() == 'e' || here() == 'E') {
      ++read_;
      const bool is_negative = here() == '-';
      if (is_negative || here() == '+') ++read_;
      const std::ptrdiff_t digits = take_digits();
      if (digits == 0 || (digits > kMostOfPower && !is_negative)) return false;
      kind = Kind::kFraction;
    }
    return add_number(kind, std::string_view(begin, static_cast<std::size_t>(read_ - begin)));
  }

  std::ptrdiff_t take_digits() {  // how many there were
    const char* at = read_;
    while (at != end() && is_digit(*at)) ++at;
    return at - std::exchange(read_, at);
  }

  bool take(char c) {
    if (next() != c) return false;
    ++read_;
    return true;
  }

  /// NUL: there is none; a text has none.
  [[nodiscard]] char here() const { return read_ != end() ? *read_ : '\0'; }
  /// The same behind blanks.
  char next() {
    const char* at = read_;
    while (at != end() && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')) ++at;
    read_ = at;
    return here();
  }
  [[nodiscard]] const char* end() const { return document_.text_.data() + document_.text_.size(); }
  [[nodiscard]] bool is_in(Kind kind) const {
    return !open_.empty() && document_.nodes_[open_.back()].kind == kind;
  }

  // ---- the document -------------------------------------------------------------------------------------

  Characters keep(std::string_view value) {
    const std::size_t begin = document_.strings_.size();
    document_.strings_ += value;
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(value.size())};
  }

  bool add(Kind kind, std::size_t begin) {
    auto& nodes = document_.nodes_;
    if (nodes.size() >= limits_.values) {
      return fail(Fault::kTooManyValues, begin,
                  core::joined({"more than ", std::to_string(limits_.values), " values"}));
    }
    if (!open_.empty()) ++nodes[open_.back()].members;
    const auto next = static_cast<std::uint32_t>(nodes.size() + 1);
    nodes.push_back({kind, static_cast<std::uint32_t>(begin), next, 0, 0, std::exchange(key_, {})});
    return true;
  }

  bool word(Kind kind, std::uint32_t size) {
    if (!add(kind, read() - size)) return false;
    document_.nodes_.back().size = size;
    return true;
  }

  bool number() {
    const std::string_view text = document_.text_;
    std::size_t end = read();
    if (end > 0 && !is_of_number(text[end - 1])) --end;
    std::size_t begin = end;
    while (begin > 0 && is_of_number(text[begin - 1])) --begin;
    const std::string_view digits = text.substr(begin, end - begin);
    return add_number(
        digits.find_first_of(".eE") == std::string_view::npos ? Kind::kInteger : Kind::kFraction, digits);
  }

  /// `digits` are of the text.
  bool add_number(Kind kind, std::string_view digits) {
    if (!add(kind, static_cast<std::size_t>(digits.data() - document_.text_.data()))) return false;
    document_.nodes_.back().size = static_cast<std::uint32_t>(digits.size());
    return true;
  }

  bool open(Kind kind) {
    if (open_.size() >= limits_.depth) {
      return fail(Fault::kTooDeep, last_read(),
                  core::joined({"nested more than ", std::to_string(limits_.depth), " deep"}));
    }
    if (!add(kind, last_read())) return false;
    document_.nodes_.back().next = Document::kOpen;
    open_.push_back(static_cast<std::uint32_t>(document_.nodes_.size() - 1));
    return true;
  }

  bool close() {
    closed_ = open_.back();
    open_.pop_back();
    Document::Node& node = document_.nodes_[closed_];
    node.next = static_cast<std::uint32_t>(document_.nodes_.size());
    node.size = static_cast<std::uint32_t>(read()) - node.begin;
    return true;
  }

  bool keys_are_distinct() {
    const auto& nodes = document_.nodes_;
    keys_.clear();
    for (std::uint32_t child = closed_ + 1; child < nodes[closed_].next; child = nodes[child].next) {
      keys_.emplace_back(document_.characters(nodes[child].key), child);
    }
    std::sort(keys_.begin(), keys_.end());
    std::uint32_t twin = kNone;  // the first in the text
    for (std::size_t i = 1; i < keys_.size(); ++i) {
      if (keys_[i].first == keys_[i - 1].first) twin = std::min(twin, keys_[i].second);
    }
    if (twin == kNone) return true;
    fail(Fault::kDuplicateKey, nodes[twin].begin, std::string(document_.characters(nodes[twin].key)));
    error_.path = document_.path_of(twin);
    return false;
  }

  bool fail(Fault fault, std::size_t offset, std::string detail) {
    error_ = {fault, offset, std::move(detail), {}};
    return false;
  }

  Limits limits_;
  const char* read_;
  std::vector<std::uint32_t> open_;                               // containers not yet closed
  std::uint32_t closed_ = 0;                                      // the last that was
  Characters key_;                                                // of the next value
  std::vector<std::pair<std::string_view, std::uint32_t>> keys_;  // of the object being closed
  Document document_;
  ParseError error_;
};

tl::expected<Document, ParseError> parse(std::string_view text, const Limits& limits) {
  return Parser(text, limits).parse();
}

}  // namespace woodlouse::json
