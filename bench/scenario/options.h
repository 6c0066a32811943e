// The command line of woodlouse-scenario.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include "shared/physics/batch.h"

namespace woodlouse::scenario {

enum class Output { kVerdict, kTable };
enum class Goldens { kCheck, kUpdate };

struct Options {
  std::vector<std::filesystem::path> places;  ///< files and folders
  std::filesystem::path maps;                 ///< empty: found from the files
  Output output = Output::kVerdict;
  Goldens goldens = Goldens::kCheck;
  std::optional<physics::InstructionSet> instructions;  ///< nothing: every one there is
  std::size_t rooms = 1;                                ///< matches of each scenario
  std::size_t threads = 1;
  std::size_t step_threads = 1;  ///< of a team that all matches share, in the finest parts
};

/// What to do, or the exit status when there is nothing to do.
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace woodlouse::scenario
