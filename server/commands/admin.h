// `woodlouse-server admin`: says one command at the door of a running server, and shows the answer.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>

#include "server/admin/admin_address.h"
#include "server/admin/command.h"

namespace woodlouse::server {

struct AdminErrand {
  AdminAddress where;
  std::optional<std::filesystem::path> token_file;  ///< for a port
  Command command;
  bool as_json = false;  ///< the answer as it came
};

inline constexpr int kAdminRefused = 1;
inline constexpr int kNoDoor = 3;

/// The answer goes to `out`, what went wrong to `err`. 0 done; kAdminRefused: the server says no; kNoDoor:
/// there is none, or no answer came.
int admin_command(const AdminErrand& errand, std::ostream& out, std::ostream& err);

}  // namespace woodlouse::server
