// What a wrong command line is told, whatever bytes stand in it.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "shared/core/printable.h"

namespace woodlouse::bench {

/// For CLI::App::failure_message().
inline std::string option_failure(const CLI::App*, const CLI::Error& error) {
  return core::printable(error.what()) + "\nRun with --help for more information.\n";
}

}  // namespace woodlouse::bench
