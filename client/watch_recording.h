// `woodlouse replay FILE`: opens the recording, borrows the terminal, shows it, gives everything back.
#pragma once

#include "client/config.h"
#include "client/terminal/outcome.h"

namespace woodlouse::client {

/// REQUIRES Part::kReplay and a terminal. The file is opened and checked before the terminal is touched. A
/// tick whose re-run differed is kExitDiffers.
Outcome watch_recording(const Config& config);

}  // namespace woodlouse::client
