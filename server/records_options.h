// The options of records, and the command `records`.
#pragma once

#include <filesystem>
#include <optional>

#include "server/commands/records.h"

namespace CLI {
class App;
}

namespace woodlouse::server {

void add_records_option(CLI::App& app, std::optional<std::filesystem::path>& folder);

/// `records` with its own commands, of which one must be given.
CLI::App* add_records_command(CLI::App& app, RecordsRequest& request);

/// The command that was named last: `records`, or one of its own.
CLI::App* named_command(CLI::App* records);

}  // namespace woodlouse::server
