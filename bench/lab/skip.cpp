// `skip`: what is not computed because the scene does not need it, and what that saves.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/big_map.h"
#include "bench/lab/job.h"
#include "bench/lab/report/output.h"
#include "bench/lab/report/race.h"
#include "bench/lab/room_usage.h"
#include "bench/lab/skip_memory.h"
#include "bench/lab/skip_steps.h"

namespace woodlouse::lab {
namespace {

struct SkipOptions {
  Output output;
  std::filesystem::path programs;
};

/// A map of 10,001 x 10,001 knots, or of 2,001 x 2,001.
core::Expected<void> measure_tiles(Table& table, const Output& output) {
  const auto usage = use_big_map(output.quick ? 2001 : 10001, 100, output.quick ? 2.0 : 60.0);
  if (!usage) return tl::unexpected(usage.error());
  const std::string map = std::to_string(static_cast<int>(usage->knots)) + "^2 knots, " +
                          std::to_string(static_cast<int>(usage->lice)) + " lice";
  table.add({"tiles nobody visits: tiles, " + map, "tiles", usage->all_tiles, usage->tiles});
  table.add({"  coefficients in memory", "MB", usage->all_tiles * 0.0361, usage->tiles * 0.0361});
  table.add({"  memory the run added", "MB", std::string("-"), usage->grown_mb});
  table.add({"  the process, without the page cache", "MB", std::string("-"), usage->resident_mb});
  table.add({"  the file's pages in the cache", "MB", std::string("-"), usage->cached_mb});
  table.add({"  from opening to every louse's first step", "s", std::string("-"), usage->open_seconds});
  table.add({"  louse-step, tiles being built included", "ns", std::string("-"), usage->ns_per_step});
  return {};
}

core::Expected<void> measure_rooms(Table& table, const SkipOptions& options) {
  const double seconds = options.output.quick ? 1.0 : 10.0;
  for (const auto& [population, name] :
       {std::pair{Population::kEmpty, "empty room"}, std::pair{Population::kResting, "resting room"}}) {
    const auto usage = use_room(options.programs, population, seconds);
    if (!usage) {
      table.add({std::string(name) + ": not run, " + usage.error().text(), "% of a core", std::string("-"),
                 std::string("-")});
      continue;
    }
    table.add(
        {std::string(name) + ", 60 Hz, " + std::to_string(static_cast<int>(usage->lice)) + " lice watching",
         "% of a core", std::string("-"), usage->percent_of_core});
  }
  return {};
}

std::filesystem::path own_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

core::Expected<void> run(const SkipOptions& options) {
  pin_to_core();
  Table table({"what is skipped", "unit", "computed", "skipped"});
  if (auto done = measure_tiles(table, options.output); !done) return done;
  if (auto done = measure_skipped_steps(table, options.output.effort()); !done) return done;
  if (auto done = measure_memory(table, options.output.effort()); !done) return done;
  if (auto done = measure_rooms(table, options); !done) return done;
  table.print(std::cout);
  return options.output.write(table, "lab-skip");
}

}  // namespace

void add_skip(CLI::App& app, Job& job) {
  CLI::App* command = app.add_subcommand("skip", "What is not computed because the scene does not need it.");
  const auto options = std::make_shared<SkipOptions>();
  options->programs = own_folder();
  add_output_options(*command, options->output);
  command->add_option("--programs", options->programs, "folder of woodlouse-server and woodlouse-swarm")
      ->check(CLI::ExistingDirectory);
  command->footer(
      "Writes lab-skip.csv. Needs 400 MB in the temporary folder (--quick: 16 MB).\n"
      "Example:\n  woodlouse-lab skip --quick");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
}

}  // namespace woodlouse::lab
