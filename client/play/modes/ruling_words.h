// What the rules of play said, as it is told in the chat.
#pragma once

#include <cstdint>
#include <string>

#include "client/play/visible_lice.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// What an event of the rules is told as; empty: not worth a line. `you`: your louse, or 0. REQUIRES a
/// sight that knows names.
std::string describe_ruling(const protocol::Event& event, std::uint32_t you, std::uint32_t tick_hz,
                            const Sight& sight);

}  // namespace woodlouse::client
