// `woodlouse-server check`: maps in files, judged.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

namespace woodlouse::server {

/// Prints to `out` that a map is fine, and what is to be noted of it, or all that is wrong with it: fields,
/// or the ghost of its race's author (author_time.h). 0 all fine, 1 one is not.
/// `summary`: and what its ground is like (map_summary.h).
int check_command(const std::vector<std::filesystem::path>& maps, bool summary, std::ostream& out);

}  // namespace woodlouse::server
