// The options of the operator's door, and the command that goes through it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/admin/admin_address.h"
#include "server/admin/command.h"
#include "server/commands/admin.h"
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

/// --password-file and --plain-passwords.
void add_password_options(CLI::App& app, std::optional<std::filesystem::path>& file, bool& may_be_plain);
void add_ban_option(CLI::App& app, std::optional<std::filesystem::path>& file);

/// As typed: what is said to the server, and where.
struct TypedErrand {
  std::string socket;
  std::optional<std::string> connect;
  std::optional<std::filesystem::path> token_file;
  bool as_json = false;
  Command command;
  std::vector<std::string> words;       ///< of `say`
  std::optional<std::string> how_long;  ///< --for, or drain's
  std::string on_or_off;                ///< record's
};

/// `admin` and its commands, each of which sets typed.command.
CLI::App* add_admin_command(CLI::App& app, TypedErrand& typed);
core::Expected<AdminErrand> checked_errand(const TypedErrand& typed);

/// Nothing: there is no such door. Errors: where = the option.
core::Expected<std::optional<AdminSettings>> checked_admin(const TypedAdmin& typed);

}  // namespace woodlouse::server
