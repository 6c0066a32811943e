// The order in which a run begins and ends: refuse what can't work, find or start a server, join it, borrow
// the terminal, play, give everything back, say what happened.
#pragma once

#include "client/config.h"

namespace woodlouse::client {

/// Runs the client; returns its exit code. Messages for the player go to standard error.
int run_client(const Config& given);

}  // namespace woodlouse::client
