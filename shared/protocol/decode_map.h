// The message `map`, read: alone, for who has no use for the others.
#pragma once

#include <string_view>

#include "shared/protocol/codec.h"
#include "shared/protocol/field_reader.h"
#include "shared/protocol/messages.h"

namespace woodlouse::protocol {

/// Its fields; what is wrong with them the reader keeps.
void read_map(FieldReader& reader, MapMessage& map);

/// A line of that type. Errors as decode_server()'s; another type is unknown_type.
tl::expected<MapMessage, DecodeError> decode_map(std::string_view line);

}  // namespace woodlouse::protocol
