// Records and ghosts, read back. Each field is of its kind and range; what no run can be, a re-run says
// (match/ghost.h).
#pragma once

#include <string_view>

#include "shared/protocol/codec.h"
#include "shared/protocol/decode_frame.h"

namespace woodlouse::protocol {

inline constexpr std::string_view kBoardTexts = R"("people", "bots" or "handed_in")";

tl::expected<ServerMessage, DecodeError> read_records(FieldReader& reader, const FrameContext& context);
tl::expected<ServerMessage, DecodeError> read_ghost(FieldReader& reader, const FrameContext& context);

}  // namespace woodlouse::protocol
