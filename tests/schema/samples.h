// Every message with every field it can have. Where a message gets another field, its sample does not
// compile: it names all members. So the field comes in here, and then the schemas (docs/schema) want it, too.
#pragma once

#include <vector>

#include "shared/protocol/messages.h"

namespace woodlouse::schema {

/// With all that may be left out, then without.
std::vector<protocol::ClientMessage> client_samples();
/// All but frames, which the server's own encoder writes; of events each kind.
std::vector<protocol::ServerMessage> server_samples();

}  // namespace woodlouse::schema
