// What the server's process is told from outside, and what its system allows it.
#pragma once

#include <cstdint>
#include <vector>

namespace woodlouse::server {

/// What a server listens to: TERM, INT, QUIT, USR1, USR2, ALRM end it in order, everybody is told and all is
/// written; none of the signals that end a program is a crash. HUP has it read its limits and log level
/// again. But those that whoever started it has ignored: nohup's HUP stays so.
std::vector<int> taken_signals();

/// Whether a terminal controls this process: a HUP from then on, once there is none, is the terminal's end.
bool has_terminal();

/// Raises the limit of open files as far as the system lets it; how many there may be.
std::uint64_t raise_descriptor_limit();

}  // namespace woodlouse::server
