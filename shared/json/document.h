// A JSON text (RFC 8259), read by nlohmann's SAX parser and strictly: valid UTF-8, no NaN or Inf, no
// duplicate keys, bounded nesting and size, integers told apart from fractions. Every value knows its place,
// so that an error can name line and field.
//
// A document is a flat list of nodes in the order of the text: a list or object is followed by its members,
// and `next` leads past them. A thousand rows cost one growing vector, not a thousand. Numbers stay text
// until asked for, so that 64 bits and the sign of -0.0 survive; no locale has a say. Strings are
// kept one behind the other.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/error.h"

namespace woodlouse::json {

/// kInteger: written without point and exponent, of any length.
enum class Kind : std::uint8_t { kNull, kBoolean, kInteger, kFraction, kString, kArray, kObject };

/// "a number", "text", ...
std::string_view to_text(Kind kind);

struct Limits {
  std::size_t depth = 8;           ///< lists and objects within one another; each takes a stack frame
  std::size_t values = 1'000'000;  ///< of all kinds together
};

inline constexpr std::size_t kMaxBytes = (std::size_t{1} << 31) - 1;  ///< of a text

/// kNotJson: syntax, bytes that are no UTF-8, a number that no double holds.
enum class Fault : std::uint8_t { kNotJson, kDuplicateKey, kTooDeep, kTooManyValues, kTooLong };

struct ParseError {
  Fault fault = Fault::kNotJson;
  std::size_t offset = 0;  ///< bytes before the fault
  std::string detail;      ///< what is wrong, in plain ASCII; of kDuplicateKey: the key, as it was sent
  std::string path;        ///< of kDuplicateKey: the key's; else empty
};

/// Where a string's characters are, escapes resolved, in the document's strings.
struct Characters {
  std::uint32_t begin = 0;
  std::uint32_t size = 0;
};

class Document;

/// One value of a document; cheap to copy, valid as long as the document.
class Value {
 public:
  Value(const Document& document, std::uint32_t index) : document_(&document), index_(index) {}

  [[nodiscard]] Kind kind() const;
  [[nodiscard]] bool is(Kind kind) const { return this->kind() == kind; }
  [[nodiscard]] bool is_number() const { return is(Kind::kInteger) || is(Kind::kFraction); }

  /// REQUIRES a boolean.
  [[nodiscard]] bool boolean() const;
  /// REQUIRES a string.
  [[nodiscard]] std::string_view text() const;
  /// The nearest double; -0 keeps its sign. REQUIRES a number.
  [[nodiscard]] double number() const;
  /// Nothing for what is no kInteger or does not fit.
  [[nodiscard]] std::optional<std::int64_t> integer() const;
  [[nodiscard]] std::optional<std::uint64_t> unsigned_integer() const;

  /// The elements or members; 0 for other kinds.
  [[nodiscard]] std::size_t size() const;
  /// Calls visit(Value) for each element or member, until it returns false.
  template <typename Visit>
  void for_each(Visit visit) const;
  /// The same as a list, to be indexed.
  [[nodiscard]] std::vector<Value> children() const;
  /// The member of that key; nothing for what is no object.
  [[nodiscard]] std::optional<Value> find(std::string_view key) const;
  /// A member's name; empty for what is no member.
  [[nodiscard]] std::string_view key() const;

  /// As it stands in the text. REQUIRES no string.
  [[nodiscard]] std::string_view raw() const;
  /// From 1, or from what parse_file() was told. Costs a walk through the text.
  [[nodiscard]] std::size_t line() const;
  /// As in `spawns[2].position`, each key as shown() cites it; empty for the whole text.
  [[nodiscard]] std::string path() const;

 private:
  const Document* document_;
  std::uint32_t index_;
};

/// The text must outlive it. Memory: 28 bytes a value, and the strings.
class Document {
 public:
  [[nodiscard]] Value root() const { return {*this, 0}; }

 private:
  friend class Value;
  friend class Parser;
  friend core::Expected<Document> parse_file(std::string_view text, std::string_view name,
                                             const Limits& limits, std::size_t first_line);

  static constexpr std::uint32_t kOpen = UINT32_MAX;  ///< Node::next of what is not yet closed

  struct Node {
    Kind kind = Kind::kNull;
    std::uint32_t begin = 0;    ///< of its first character in the text
    std::uint32_t next = 0;     ///< index after this and its descendants
    std::uint32_t members = 0;  ///< of a list or object; of a string: where its characters begin
    std::uint32_t size = 0;     ///< bytes in the text; of a string: of its characters
    Characters key;             ///< where the parent is an object
  };

  [[nodiscard]] std::string_view characters(Characters at) const {
    return std::string_view(strings_).substr(at.begin, at.size);
  }
  [[nodiscard]] std::string path_of(std::uint32_t index) const;

  std::string_view text_;
  std::size_t first_line_ = 1;
  std::vector<Node> nodes_;  ///< nodes_[0] is the root
  std::string strings_;
};

tl::expected<Document, ParseError> parse(std::string_view text, const Limits& limits);

/// The same for a file, or a part of it that begins at `first_line`. Errors: where = "name:line" or
/// "name:line: field".
core::Expected<Document> parse_file(std::string_view text, std::string_view name, const Limits& limits,
                                    std::size_t first_line = 1);

inline Kind Value::kind() const { return document_->nodes_[index_].kind; }

inline std::string_view Value::key() const { return document_->characters(document_->nodes_[index_].key); }

inline std::string_view Value::text() const {
  assert(is(Kind::kString));
  const Document::Node& node = document_->nodes_[index_];
  return document_->characters({node.members, node.size});
}

inline std::string_view Value::raw() const {
  assert(!is(Kind::kString));
  const Document::Node& node = document_->nodes_[index_];
  return document_->text_.substr(node.begin, node.size);
}

inline std::size_t Value::size() const {
  return is(Kind::kArray) || is(Kind::kObject) ? document_->nodes_[index_].members : 0;
}

template <typename Visit>
void Value::for_each(Visit visit) const {
  const auto& nodes = document_->nodes_;
  for (std::uint32_t child = index_ + 1; child < nodes[index_].next; child = nodes[child].next) {
    if (!visit(Value(*document_, child))) return;
  }
}

}  // namespace woodlouse::json
