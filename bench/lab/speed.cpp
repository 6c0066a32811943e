// `speed`: our evaluations and steps beside GSL's, ALGLIB's and the document's, in one run.
#include "bench/lab/job.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>
#include "bench/lab/report/output.h"
#include "bench/lab/report/race.h"
#include "bench/lab/speed/evaluations.h"
#include "bench/lab/speed/maps.h"
#include "bench/lab/speed/modes.h"
#include "bench/lab/speed/steps.h"

namespace woodlouse::lab {
namespace {

struct SpeedOptions {
  Output output;
  std::filesystem::path maps;     ///< empty: the project's own
  std::vector<std::string> only;  ///< empty: all
};

core::Expected<void> run(const SpeedOptions& options) {
  const auto asks_for = [&](const char* part) {
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), part) != options.only.end();
  };
  pin_to_core();
  if (asks_for("evaluations")) {
    if (auto done = measure_evaluations(options.output); !done) return done;
  }
  if (asks_for("steps")) {
    if (auto done = measure_steps(options.output); !done) return done;
  }
  if (asks_for("maps")) {
    if (auto done = measure_maps(options.maps, options.output); !done) return done;
  }
  if (asks_for("modes")) {
    if (auto done = measure_modes(options.maps, options.output); !done) return done;
  }
  if (asks_for("threads")) return measure_threads(options.maps, options.output);
  return {};
}

}  // namespace

void add_speed(CLI::App& app, Job& job) {
  CLI::App* command = app.add_subcommand(
      "speed", "Evaluations and steps beside GSL, ALGLIB and the document's; every map's tick.");
  const auto options = std::make_shared<SpeedOptions>();
  add_output_options(*command, options->output);
  command->add_option("--maps", options->maps, "folder of maps; the project's own when left out")
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--only", options->only, "some of evaluations,steps,maps,modes,threads; all when left out")
      ->delimiter(',')
      ->check(CLI::IsMember({"evaluations", "steps", "maps", "modes", "threads"}));
  command->footer(
      "Writes lab-speed-evaluations.csv, -steps.csv, -maps.csv, -modes.csv and -threads.csv; prints the "
      "ratios.\n"
      "Example:\n  woodlouse-lab speed --quick");
  command->callback([options, &job] {
    for (const std::string& part : options->only)
      options->output.command += (&part == &options->only.front() ? " --only " : ",") + part;
    job = [options] { return run(*options); };
  });
}

}  // namespace woodlouse::lab
