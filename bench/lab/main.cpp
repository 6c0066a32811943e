// woodlouse-lab: run time against error of every method, as facts that anyone can reproduce.
#include <CLI/CLI.hpp>
#include <iostream>

#include "bench/lab/job.h"
#include "bench/option_failure.h"

int main(int argc, char** argv) {
  using namespace woodlouse::lab;
  CLI::App app("Measures every surface, equation and integrator: run time against error.");
  app.footer(
      "Example:\n  woodlouse-lab speed --quick\nEach subcommand has a --help with an example of its own.");
  app.require_subcommand(1);
  Job job;
  add_sample(app, job);
  add_trajectory(app, job);
  add_precision(app, job);
  add_stability(app, job);
  add_speed(app, job);
  add_skip(app, job);
  add_figures(app, job);
  app.failure_message(woodlouse::bench::option_failure);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const auto done = job();
  if (done) return 0;
  const auto& error = done.error();
  std::cout.flush();
  std::cerr << "woodlouse-lab: " << error.where << ": " << error.what << '\n';
  if (!error.hint.empty()) std::cerr << "  " << error.hint << '\n';
  return 2;
}
