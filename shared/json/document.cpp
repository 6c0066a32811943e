#include "shared/json/document.h"

#include <charconv>

#include "shared/core/joined.h"
#include "shared/json/decimal_number.h"
#include "shared/json/text.h"

namespace woodlouse::json {
namespace {

template <typename Integer>
std::optional<Integer> whole(std::string_view text) {
  Integer value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end) return std::nullopt;
  return value;
}

std::size_t line_at(std::string_view text, std::size_t offset, std::size_t first_line) {
  const std::string_view before = text.substr(0, offset);
  return first_line + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

}  // namespace

std::string_view to_text(Kind kind) {
  switch (kind) {
    case Kind::kNull:
      return "null";
    case Kind::kBoolean:
      return "true or false";
    case Kind::kInteger:
      return "a number";
    case Kind::kFraction:
      return "a number";
    case Kind::kString:
      return "text";
    case Kind::kArray:
      return "a list";
    case Kind::kObject:
      return "an object";
  }
  assert(false);
  return {};
}

bool Value::boolean() const {
  assert(is(Kind::kBoolean));
  return raw().front() == 't';
}

double Value::number() const {
  assert(is_number());
  const std::string_view text = raw();
  constexpr std::size_t kShort = 15;  // characters; as an integer it is exact, and quicker to read
  if (is(Kind::kInteger) && text.size() <= kShort) {
    const std::int64_t value = *whole<std::int64_t>(text);
    if (value != 0) return static_cast<double>(value);
  }
  double value = text.front() == '-' ? -0.0 : 0.0;  // left as it is by what is too small for a double
  read_decimal(text.data(), text.data() + text.size(), value);
  return value;
}

std::optional<std::int64_t> Value::integer() const {
  if (!is(Kind::kInteger)) return std::nullopt;
  return whole<std::int64_t>(raw());
}

std::optional<std::uint64_t> Value::unsigned_integer() const {
  if (!is(Kind::kInteger)) return std::nullopt;
  return whole<std::uint64_t>(raw());
}

std::vector<Value> Value::children() const {
  std::vector<Value> result;
  result.reserve(size());
  for_each([&](Value child) {
    result.push_back(child);
    return true;
  });
  return result;
}

std::optional<Value> Value::find(std::string_view key) const {
  if (!is(Kind::kObject)) return std::nullopt;
  std::optional<Value> found;
  for_each([&](Value member) {
    if (member.key() == key) found = member;
    return !found;
  });
  return found;
}

std::size_t Value::line() const {
  return line_at(document_->text_, document_->nodes_[index_].begin, document_->first_line_);
}

std::string Value::path() const { return document_->path_of(index_); }

std::string Document::path_of(std::uint32_t index) const {
  std::string path;
  std::uint32_t parent = 0;
  while (parent != index) {
    std::size_t position = 0;
    std::uint32_t child = parent + 1;
    for (; nodes_[child].next <= index; child = nodes_[child].next) ++position;
    if (nodes_[parent].kind == Kind::kArray) {
      path += core::joined({"[", std::to_string(position), "]"});
    } else {
      path += core::joined({path.empty() ? "" : ".", shown(characters(nodes_[child].key))});
    }
    parent = child;
  }
  return path;
}

core::Expected<Document> parse_file(std::string_view text, std::string_view name, const Limits& limits,
                                    std::size_t first_line) {
  auto document = parse(text, limits);
  if (document) {
    document->first_line_ = first_line;
    return std::move(*document);
  }
  const ParseError& error = document.error();
  const bool is_twin = error.fault == Fault::kDuplicateKey;
  std::string where = core::joined({name, ":", std::to_string(line_at(text, error.offset, first_line))});
  if (is_twin) return core::fail(core::joined({where, ": ", error.path}), "stands twice", "keep one of them");
  return core::fail(std::move(where),
                    core::joined({error.fault == Fault::kNotJson ? "not JSON: " : "", error.detail}));
}

}  // namespace woodlouse::json
