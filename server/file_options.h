// The options of the commands that read a file: maps and recordings.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>

#include "server/config.h"

namespace woodlouse::server {

/// `check` and what it is told.
CLI::App* add_check(CLI::App& app, CheckConfig& config);
/// `make-map` alike.
CLI::App* add_make_map(CLI::App& app, MakeMapRequest& request);

/// Where the map of a recording may be.
void add_maps(CLI::App& command, std::filesystem::path& maps);
/// `verify` and `inspect`.
CLI::App* add_verify(CLI::App& app, VerifyRequest& request);
CLI::App* add_inspect(CLI::App& app, InspectRequest& request);

}  // namespace woodlouse::server
