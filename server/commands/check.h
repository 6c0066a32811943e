// `woodlouse-server check`: maps in files, judged.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

namespace woodlouse::server {

/// Prints to `out` that a map is fine or all that is wrong with it; 0 all fine, 1 one is not.
int check_command(const std::vector<std::filesystem::path>& maps, std::ostream& out);

}  // namespace woodlouse::server
