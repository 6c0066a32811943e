// The options of the commands that look at maps and make them.
#pragma once

#include <CLI/CLI.hpp>

#include "server/config.h"

namespace woodlouse::server {

/// `check` and what it is told.
CLI::App* add_check(CLI::App& app, CheckConfig& config);
/// `make-map` alike.
CLI::App* add_make_map(CLI::App& app, MakeMapRequest& request);

}  // namespace woodlouse::server
