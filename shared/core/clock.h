// The one clock of server and client: monotonic, never set back. Nothing else in shared/ asks what time it
// is: a time comes as an argument.
#pragma once

#include <chrono>

namespace woodlouse::core {

using Clock = std::chrono::steady_clock;
using Time = Clock::time_point;
using Duration = Clock::duration;

}  // namespace woodlouse::core
