// The one clock of the server: monotonic, never set back. Pure parts take a Time as an argument.
#pragma once

#include <chrono>

namespace woodlouse::server {

using Clock = std::chrono::steady_clock;
using Time = Clock::time_point;
using Duration = Clock::duration;

}  // namespace woodlouse::server
