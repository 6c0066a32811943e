// `speed`: our evaluations and steps beside GSL's, ALGLIB's and the document's, in one run.
#include "bench/lab/job.h"

#include <CLI/CLI.hpp>
#include "bench/lab/report/output.h"
#include "bench/lab/report/race.h"
#include "bench/lab/speed_evaluations.h"
#include "bench/lab/speed_steps.h"

namespace woodlouse::lab {
namespace {

core::Expected<void> run(const Output& output) {
  pin_to_core();
  if (auto done = measure_evaluations(output); !done) return done;
  return measure_steps(output);
}

}  // namespace

void add_speed(CLI::App& app, Job& job) {
  CLI::App* command =
      app.add_subcommand("speed", "Evaluations and steps beside GSL, ALGLIB and the document's.");
  const auto output = std::make_shared<Output>();
  add_output_options(*command, *output);
  command->footer(
      "Writes lab-speed-evaluations.csv and lab-speed-steps.csv; prints the ratios.\n"
      "Example:\n  woodlouse-lab speed --quick");
  command->callback([output, &job] { job = [output] { return run(*output); }; });
}

}  // namespace woodlouse::lab
