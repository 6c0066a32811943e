// The texts of the wire's enumerations and message types, read back; shared by both directions of the codec.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "shared/protocol/codes.h"
#include "shared/protocol/line_object.h"
#include "shared/protocol/messages.h"

namespace woodlouse::protocol {

inline constexpr std::string_view kRoleTexts = R"("player", "bot" or "spectator")";
inline constexpr std::string_view kFormatTexts = R"("quantized" or "exact")";

inline constexpr std::string_view kStreamTexts = R"("frames" or "inputs")";

inline std::optional<Stream> stream_from_text(std::string_view text) {
  for (const Stream stream : {Stream::kFrames, Stream::kInputs}) {
    if (to_text(stream) == text) return stream;
  }
  return std::nullopt;
}

inline std::optional<Format> format_from_text(std::string_view text) {
  for (const Format format : {Format::kQuantized, Format::kExact}) {
    if (to_text(format) == text) return format;
  }
  return std::nullopt;
}

/// The names of all columns, separated by blanks.
inline std::string column_names() {
  std::string names;
  for (std::size_t i = 0; i < kColumnCount; ++i) {
    if (i > 0) names += ' ';
    names += to_text(static_cast<Column>(i));
  }
  return names;
}

/// The entry of `types` that the document's `type` names. Errors: missing_field, bad_field, unknown_type.
template <typename Read, std::size_t N>
tl::expected<const std::pair<std::string_view, Read>*, DecodeError> read_type(
    const json::Document& document, const std::array<std::pair<std::string_view, Read>, N>& types) {
  const auto known = [&types] {
    std::string names;
    for (const auto& type : types) names += (names.empty() ? "" : ", ") + std::string(type.first);
    return names;
  };
  const auto value = document.root().find("type");
  if (!value) {
    return tl::unexpected(
        DecodeError{std::string(code::kMissingField), "type is missing; it is one of: " + known()});
  }
  if (value->kind() != json::Kind::kString) {
    return tl::unexpected(
        DecodeError{std::string(code::kBadField),
                    "type is " + description(*value) + "; it must be a string, one of: " + known()});
  }
  for (const auto& type : types) {
    if (type.first == value->text()) return &type;
  }
  return tl::unexpected(DecodeError{std::string(code::kUnknownType),
                                    "type is " + description(*value) + "; it must be one of: " + known()});
}

}  // namespace woodlouse::protocol
