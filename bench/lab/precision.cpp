// `precision`: run time against error, of the integrators and of the surfaces.
#include <iostream>

#include "bench/lab/job.h"
#include "bench/lab/names.h"
#include "bench/lab/output.h"
#include "bench/lab/precision_integrators.h"
#include "bench/lab/precision_surfaces.h"
#include "bench/lab/race.h"

namespace woodlouse::lab {
namespace {

struct PrecisionOptions {
  Output output;
  std::string function = "wavy_pot";
};

core::Expected<void> run(const PrecisionOptions& options) {
  const auto function = function_named(options.function);
  if (!function) return tl::unexpected(function.error());
  pin_to_core();
  if (auto done = measure_integrators(*function, options.output); !done) return done;
  return measure_surfaces(*function, options.output);
}

}  // namespace

void add_precision(CLI::App& app, Job& job) {
  CLI::App* command = app.add_subcommand("precision", "Work-precision diagrams: nanoseconds against error.");
  const auto options = std::make_shared<PrecisionOptions>();
  command->add_option("--function", options->function, names_of(terrain::kFunctionNames))->capture_default_str();
  add_output_options(*command, options->output);
  command->footer(
      "Writes lab-precision-integrators and lab-precision-surfaces as .csv, .svg and .png.\n"
      "Example:\n  woodlouse-lab precision --quick --out .");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
}

}  // namespace woodlouse::lab
