// The options of the operator's door, and the command that goes through it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "server/admin/admin_address.h"
#include "shared/core/error.h"

namespace CLI {
class App;
}

namespace woodlouse::server {

/// As typed, before they are checked.
struct TypedAdmin {
  std::optional<std::string> where;
  std::optional<std::filesystem::path> token_file;
};

void add_admin_options(CLI::App& app, TypedAdmin& typed);

/// Nothing: there is no such door. Errors: where = the option.
core::Expected<std::optional<AdminSettings>> checked_admin(const TypedAdmin& typed);

}  // namespace woodlouse::server
