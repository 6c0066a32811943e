// Keys and deltas, read: the rows' shape comes from the welcome.
#pragma once

#include <string_view>
#include <vector>

#include "shared/protocol/field_reader.h"
#include "shared/protocol/messages.h"

namespace woodlouse::protocol {

/// What a row looks like, for the messages that need it.
struct FrameContext {
  const std::vector<Column>& fields;
  Format format;
};

tl::expected<ServerMessage, DecodeError> read_key(FieldReader& reader, const FrameContext& context);
tl::expected<ServerMessage, DecodeError> read_delta(FieldReader& reader, const FrameContext& context);

}  // namespace woodlouse::protocol
