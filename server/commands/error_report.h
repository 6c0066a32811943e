// `woodlouse-server inspect --error`: how far the steps of a recording err.
#pragma once

#include <memory>
#include <string>

#include "shared/core/error.h"
#include "shared/replay/archive.h"

namespace woodlouse::server {

/// For each player and for all: bounds of the local error a second of play, the worst tick, and how far a
/// twin at half the step was away after windows of 10 s (match/step_error.h, match/twin.h). All of it is
/// re-run, which costs 68 steps for each. A table for people. Errors: the recording is damaged, or was not
/// played so.
core::Expected<std::string> error_report(const replay::ReplayArchive& archive);

}  // namespace woodlouse::server
