// `woodlouse-server verify`: recordings in files, judged.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

namespace woodlouse::server {

/// Prints the verdicts to `out`, of several files each under its name; 0 all the same, 1 one different or
/// unreadable.
int verify_command(const std::vector<std::filesystem::path>& files, unsigned jobs, std::ostream& out);

}  // namespace woodlouse::server
