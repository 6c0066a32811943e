// `precision`: run time against error, of the integrators, of the surfaces, under central gravity and in
// flight; and the order of the error, event by event.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "bench/lab/game/error_hour.h"
#include "bench/lab/game/local_error.h"
#include "bench/lab/game/precision.h"
#include "bench/lab/job.h"
#include "bench/lab/precision_flight.h"
#include "bench/lab/precision_integrators.h"
#include "bench/lab/precision_kepler.h"
#include "bench/lab/precision_orders.h"
#include "bench/lab/precision_surfaces.h"
#include "bench/lab/problems/names.h"
#include "bench/lab/report/output.h"
#include "bench/lab/report/race.h"

namespace woodlouse::lab {
namespace {

struct PrecisionOptions {
  Output output;
  std::string function = "wavy_pot";
  std::string only;            ///< empty: all
  std::filesystem::path maps;  ///< empty: the project's own
};

constexpr std::array<std::string_view, 9> kProblems = {
    "maps", "integrators", "surfaces", "kepler", "orders", "flight", "local", "tolerance", "hour"};

std::string problem_names() {
  std::string names;
  for (const std::string_view problem : kProblems) {
    if (!names.empty()) names += ' ';
    names += problem;
  }
  return names;
}

core::Expected<void> run(const PrecisionOptions& options) {
  const auto function = function_named(options.function);
  if (!function) return tl::unexpected(function.error());
  if (!options.only.empty() &&
      std::find(kProblems.begin(), kProblems.end(), options.only) == kProblems.end()) {
    return core::fail("--only", "there is no \"" + options.only + "\"", "one of: " + problem_names());
  }
  pin_to_core();
  const auto wanted = [&](std::string_view problem) {
    return options.only.empty() || options.only == problem;
  };
  if (wanted("maps")) {
    if (auto done = measure_game_precision(options.maps, options.output); !done) return done;
  }
  if (wanted("integrators")) {
    if (auto done = measure_integrators(*function, options.output); !done) return done;
  }
  if (wanted("surfaces")) {
    if (auto done = measure_surfaces(*function, options.output); !done) return done;
  }
  if (wanted("kepler")) {
    if (auto done = measure_kepler(options.output); !done) return done;
  }
  if (wanted("orders")) {
    if (auto done = measure_orders(options.output); !done) return done;
  }
  if (wanted("flight")) {
    if (auto done = measure_flight(options.output); !done) return done;
    if (auto done = measure_flight_cost(options.output); !done) return done;
  }
  if (wanted("local")) {
    if (auto done = measure_local_error(options.maps, options.output); !done) return done;
  }
  if (wanted("tolerance")) {
    if (auto done = measure_tolerance(options.maps, options.output); !done) return done;
  }
  if (wanted("hour")) return measure_error_hour(options.output);
  return {};
}

}  // namespace

void add_precision(CLI::App& app, Job& job) {
  CLI::App* command = app.add_subcommand("precision", "Work-precision diagrams: nanoseconds against error.");
  const auto options = std::make_shared<PrecisionOptions>();
  command->add_option("--function", options->function, names_of(terrain::kFunctionNames))
      ->capture_default_str();
  command->add_option("--only", options->only, problem_names() + "; all of them when left out");
  command->add_option("--maps", options->maps, "folder of maps; the project's own when left out")
      ->check(CLI::ExistingDirectory);
  add_output_options(*command, options->output);
  command->footer(
      "Writes lab-precision-maps (the shipped maps as they are played), -integrators, -surfaces, -kepler, "
      "-flight, lab-local-error (what is told of a tick's error against the true one) and lab-error-hour "
      "(both "
      "of an hour's play) as .csv, .svg and .png, -flight-cost and lab-tolerance (maps that bear only so "
      "much of "
      "error) as .csv; orders, of the rooms' methods at walls, seams, flights, stops and "
      "thrusts, is printed "
      "alone.\n"
      "Example:\n  woodlouse-lab precision --quick --only maps --out .");
  command->callback([options, &job] {
    if (!options->only.empty()) options->output.command += " --only " + options->only;
    job = [options] { return run(*options); };
  });
}

}  // namespace woodlouse::lab
