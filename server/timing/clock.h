// The clock's types under the server's roof. Who asks what time it is asks a Timekeeper (timekeeper.h).
#pragma once

#include "shared/core/clock.h"

namespace woodlouse::server {

using core::Clock;
using core::Duration;
using core::Time;

}  // namespace woodlouse::server
