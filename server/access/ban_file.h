// Bans in a file: a JSON object a line, {"address":"192.0.2.0/24","since":1767225600,"until":1767229200} or
// {"name":"ann",...}; without `until`, for good. People may write it too. It is written whole, beside the old
// one, and then put in its place: whatever fails, one of the two is there.
#pragma once

#include <filesystem>

#include "server/access/bans.h"
#include "shared/core/error.h"

namespace woodlouse::server {

/// None where there is no such file. Errors: the first line that can't be taken, and why.
core::Expected<Bans> read_bans(const std::filesystem::path& file);
/// May wait for the disk. Errors: nothing is changed then.
core::Expected<void> write_bans(const std::filesystem::path& file, const Bans& bans);

}  // namespace woodlouse::server
