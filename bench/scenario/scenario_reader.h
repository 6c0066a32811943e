// Reads scenario files: every byte is checked here, once. Format: docs/determinism.md.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "bench/scenario/scenario.h"
#include "shared/core/error.h"

namespace woodlouse::scenario {

/// A scenario, or everything that is wrong with its file (where = "file:line: field").
struct ReadScenario {
  std::optional<Scenario> scenario;
  std::vector<core::Error> errors;
};

/// maps: the folder in which a map is looked up by name; empty: the nearest folder `maps` beside the file or
/// above it.
ReadScenario read_scenario(const std::filesystem::path& file, const std::filesystem::path& maps);

/// The files; a folder stands for the *.json in it, by name. Errors: what is not there, a folder without any,
/// two of one name.
core::Expected<std::vector<std::filesystem::path>> find_scenarios(
    const std::vector<std::filesystem::path>& places);

}  // namespace woodlouse::scenario
