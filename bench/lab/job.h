// What a subcommand leaves to do once its options are parsed. Each subcommand is a file pair with one
// function that adds it to the command line.
#pragma once

#include <functional>

#include "shared/core/error.h"

namespace CLI {
class App;
}

namespace woodlouse::lab {

using Job = std::function<core::Expected<void>()>;

void add_sample(CLI::App& app, Job& job);
void add_trajectory(CLI::App& app, Job& job);
void add_precision(CLI::App& app, Job& job);
void add_stability(CLI::App& app, Job& job);
void add_speed(CLI::App& app, Job& job);
void add_skip(CLI::App& app, Job& job);
void add_figures(CLI::App& app, Job& job);

}  // namespace woodlouse::lab
