// The line that answers every input, with the exact state: written at once, without an object's bookkeeping.
#pragma once

#include <string>

#include "shared/protocol/messages.h"

namespace woodlouse::protocol {

/// Appends the line, newline included.
void append_ack(std::string& out, const Ack& ack);

}  // namespace woodlouse::protocol
