// Which rooms a server and its cluster have, as a list for people: woodlouse --rooms HOST:PORT.
#pragma once

#include <string>

#include "client/net/address.h"
#include "shared/core/error.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// A line each under a line of headings; what a stranger wrote in it is cleaned by who read it.
[[nodiscard]] std::string table_of(const protocol::Rooms& rooms);

/// Asks that server, for 5 s at most. Error: as of why_not_joined().
core::Expected<protocol::Rooms> ask_for_rooms(const Address& server);

}  // namespace woodlouse::client
