// What the rules of play say, as the wire has it.
#pragma once

#include "server/frames/frame_encoder.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"
#include "shared/rules/rules.h"

namespace woodlouse::server {

/// What there is to see of a match now.
Scene scene_of(const match::Match& game, std::uint64_t ticks_a_frame);

/// Without its number and name. A round's has the rules' table.
protocol::Event shown_event(const rules::Event& event, const rules::Rules& rules);

}  // namespace woodlouse::server
