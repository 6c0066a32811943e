// The JSON object of a line, its faults told in the wire's codes.
#pragma once

#include <string>
#include <string_view>

#include "shared/json/document.h"
#include "shared/protocol/codec.h"

namespace woodlouse::protocol {

/// Nesting of at most kMaxDepth. Errors: bad_json (is_json false), not_an_object, duplicate_key, too_deep.
tl::expected<json::Document, DecodeError> parse_object(std::string_view line);

/// A value as an error's text shows it: `"fast"`, `1.5`, `an array of 3`.
std::string description(json::Value value);

}  // namespace woodlouse::protocol
