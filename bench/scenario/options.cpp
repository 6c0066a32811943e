#include "bench/scenario/options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "bench/option_failure.h"
#include "shared/core/thread_team.h"

namespace woodlouse::scenario {

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  CLI::App app(
      "Plays matches from scripts and compares their state hashes: deterministic tests without C++.");
  app.footer("How to write one: docs/determinism.md.");
  app.require_subcommand(1);
  CLI::App& run =
      *app.add_subcommand("run",
                          "plays the scenarios; exit status 0: all hashes are right, 1: one is not, "
                          "2: a file or option is wrong, 3: nothing was run");
  run.footer("Example:\n  woodlouse-scenario run tests/scenarios");
  run.add_option("FILE", options.places, "scenario files, or folders of them")->required();
  bool table = false;
  bool update = false;
  run.add_flag("--table", table, "print \"scenario tick hash\" lines, the same everywhere");
  run.add_flag("--update", update, "write the hashes into the files after a wanted change of behavior");
  std::string instructions = "all";
  run.add_option("--instructions", instructions, "scalar, avx2, avx512 or all that this machine has")
      ->check(CLI::IsMember({"scalar", "avx2", "avx512", "all"}))
      ->capture_default_str();
  run.add_option("--rooms", options.rooms, "how many matches of each scenario are played side by side")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  run.add_option("--threads", options.threads, "that step the matches in turns")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  run.add_option("--step-threads", options.step_threads,
                 "that share the steps of each match, cut as finely as can be")
      ->check(CLI::Range(std::size_t{1}, core::ThreadTeam::kMostThreads))
      ->capture_default_str();
  run.add_option("--maps", options.maps,
                 "folder of the maps named in the files; default: maps/ beside or above them");
  app.failure_message(bench::option_failure);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (table) options.output = Output::kTable;
  if (update) options.goldens = Goldens::kUpdate;
  for (const auto set :
       {physics::InstructionSet::kScalar, physics::InstructionSet::kAvx2, physics::InstructionSet::kAvx512}) {
    if (instructions == physics::to_text(set)) options.instructions = set;
  }
  return options;
}

}  // namespace woodlouse::scenario
