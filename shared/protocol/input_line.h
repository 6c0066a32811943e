// The line that comes most often, read without a document: {"type":"input",...} as programs write it.
#pragma once

#include <optional>
#include <string_view>

#include "shared/protocol/messages.h"

namespace woodlouse::protocol {

/// What decode_client() gives for that line, where it is a flat input without anything unusual: members in
/// any order, each once, all of them known, numbers without exponent, blanks alone between. Nothing: it is
/// another line, or one that only the document's parser can judge.
std::optional<Input> scan_input(std::string_view line);

}  // namespace woodlouse::protocol
