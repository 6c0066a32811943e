#include "shared/protocol/line_object.h"

#include <cassert>
#include <cstdint>

#include "shared/json/text.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/text_cleaning.h"

namespace woodlouse::protocol {
namespace {

constexpr std::size_t kMaxShownBytes = 40;  // of what was found, in an error's text

std::string cut(std::string_view text) {
  std::string shown = clean_text(text, kMaxShownBytes);
  if (shown.size() < text.size() && text.size() > kMaxShownBytes) shown += "...";
  return shown;
}

std::string in_quotes(std::string_view text) {
  std::string out;
  json::append_string(out, cut(text));
  return out;
}

tl::unexpected<DecodeError> refused(std::string_view name, std::string text) {
  return tl::unexpected(DecodeError{std::string(name), std::move(text), name != code::kBadJson});
}

tl::unexpected<DecodeError> refused(const json::ParseError& error) {
  switch (error.fault) {
    case json::Fault::kDuplicateKey:
      return refused(code::kDuplicateKey,
                     "the key " + in_quotes(error.detail) + " stands twice in one object; send it once");
    case json::Fault::kTooDeep:
      return refused(code::kTooDeep, "nested deeper than " + std::to_string(kMaxDepth) +
                                         ": no message needs that; send flat objects");
    case json::Fault::kNotJson:
    case json::Fault::kTooManyValues:
    case json::Fault::kTooLong:
      break;
  }
  return refused(code::kBadJson, "not JSON at byte " + std::to_string(error.offset + 1) + ": " +
                                     error.detail + "; send one JSON object a line, as {\"type\":\"list\"}");
}

}  // namespace

tl::expected<json::Document, DecodeError> parse_object(std::string_view line) {
  // The line's length bounds the number of its values.
  auto document = json::parse(line, {static_cast<std::size_t>(kMaxDepth), SIZE_MAX});
  if (!document) return refused(document.error());
  if (!document->root().is(json::Kind::kObject)) {
    return refused(code::kNotAnObject,
                   "a line is one JSON object, as {\"type\":\"list\"}; this one is another value");
  }
  return std::move(*document);
}

std::string description(json::Value value) {
  switch (value.kind()) {
    case json::Kind::kNull:
    case json::Kind::kBoolean:
    case json::Kind::kInteger:
    case json::Kind::kFraction:
      return cut(value.raw());
    case json::Kind::kString:
      return in_quotes(value.text());
    case json::Kind::kArray:
      return "an array of " + std::to_string(value.size());
    case json::Kind::kObject:
      return "an object";
  }
  assert(false);
  return {};
}

}  // namespace woodlouse::protocol
