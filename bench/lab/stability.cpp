// `stability`: every integrator over slopes, curvatures, speeds, frictions, rates and grids; and a long soak.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "bench/lab/gains.h"
#include "bench/lab/game/rounding.h"
#include "bench/lab/game/stability.h"
#include "bench/lab/game/stress.h"
#include "bench/lab/job.h"
#include "bench/lab/problems/egg_crate.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/problems/names.h"
#include "bench/lab/report/output.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"
#include "bench/lab/soak.h"

namespace woodlouse::lab {
namespace {

constexpr double kGravity = 9.81;
constexpr double kGoal = 1e-4;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct StabilityOptions {
  Output output;
  std::string integrator = "all";
  std::filesystem::path maps;     ///< empty: the project's own
  std::vector<std::string> only;  ///< empty: all
  std::size_t random = 0;         ///< maps made by chance; 0: as many as the effort says
  std::uint64_t seed = 1;         ///< of the first of them
};

constexpr std::array kParts = {"crates", "maps", "soak", "gains", "random", "rounding"};

struct Axes {
  std::vector<double> slopes, curvatures, speeds, frictions, rates, knots_per_wave;
  double seconds;
};

Axes axes_of(Effort effort) {
  if (effort == Effort::kQuick) return {{1, 20}, {20, 2000}, {1}, {0, 0.05}, {15, 240}, {8}, 1.0};
  return {{0.2, 1, 5, 20},
          {1, 20, 200, 2000},
          {0.1, 1, 10},
          {0, 0.05, 0.5},
          {15, 30, 60, 120, 240},
          {8, 32},
          10.0};
}

struct Cell {
  double slope, curvature, speed, friction, rate, knots_per_wave;
  double energy_error = 0.0;  ///< of the energy above the lowest point; with friction only what is gained
  double gained = 0.0;        ///< energy from nothing, likewise
  double first_nan = kNone;   ///< [s]
  double penetration = 0.0;   ///< of the edge [m]
  double capped = 0.0;        ///< share of the sub-steps that wanted to be shorter than the cap allows
  double sub_steps = 0.0;     ///< a tick
};

bool is_finite(const state::Louse& louse) {
  return std::isfinite(louse.position.x) && std::isfinite(louse.position.y) &&
         std::isfinite(louse.velocity.x) && std::isfinite(louse.velocity.y);
}

double penetration(const terrain::Rectangle& walls, core::Vec2 p) {
  return std::max({walls.x_min - p.x, p.x - walls.x_max, walls.y_min - p.y, p.y - walls.y_max, 0.0});
}

/// Runs one louse between elastic walls and fills the cell's results.
core::Expected<void> run(Cell& cell, const EggCrate& crate, Integrator integrator, double seconds) {
  const state::Parameters parameters{kGravity, 0.0, cell.friction, 0.0, 1.0};
  const document::AnySurface& surface = crate.surface;
  const terrain::Rectangle walls = crate.walls;
  const auto stepper =
      make_stepper(surface, Equations::kSurface, integrator, parameters, walls, 1.0 / cell.rate);
  if (!stepper) return tl::unexpected(stepper.error());

  // Off every axis of symmetry, on the flank of a dent.
  const core::Vec2 at{walls.x_min + 0.37 * (walls.x_max - walls.x_min),
                      walls.y_min + 0.46 * (walls.y_max - walls.y_min)};
  const core::Vec2 along{0.8, 0.6};
  const terrain::SurfaceSample s = sample_of(surface, at);
  state::Louse louse =
      louse_at(at, (cell.speed / std::sqrt(physics::squared_length_in_space(s, along))) * along);
  const double floor = kGravity * crate.lowest;
  const double start = energy_of(s, louse.velocity, kGravity) - floor;
  double lowest = start;
  physics::StepCounters counters;
  const long ticks = std::lround(seconds * cell.rate);
  for (long tick = 1; tick <= ticks && louse.phase != state::Phase::kResting; ++tick) {
    (*stepper)->advance({&louse, 1}, counters);
    if (!is_finite(louse)) {
      cell.first_nan = static_cast<double>(tick) / cell.rate;
      break;
    }
    cell.penetration = std::max(cell.penetration, penetration(walls, louse.position));
    const double energy = energy_of(sample_of(surface, louse.position), louse.velocity, kGravity) - floor;
    const double error = cell.friction > 0.0 ? energy - lowest : std::fabs(energy - start);
    cell.energy_error = std::fmax(cell.energy_error, std::isfinite(error) ? error / start : 1e300);
    cell.gained = std::fmax(cell.gained, (energy - (cell.friction > 0.0 ? lowest : start)) / start);
    lowest = std::fmin(lowest, energy);
  }
  cell.capped = static_cast<double>(counters.capped) /
                static_cast<double>(std::max<std::uint64_t>(1, counters.sub_steps));
  cell.sub_steps = static_cast<double>(counters.sub_steps) /
                   static_cast<double>(std::max<std::uint64_t>(1, counters.louse_steps));
  return {};
}

core::Expected<std::vector<Cell>> run_all(Integrator integrator, const Axes& axes) {
  std::vector<Cell> cells;  // those of a crate one after the other
  for (const double slope : axes.slopes) {
    for (const double curvature : axes.curvatures) {
      for (const double knots : axes.knots_per_wave) {
        for (const double speed : axes.speeds) {
          for (const double friction : axes.frictions) {
            for (const double rate : axes.rates)
              cells.push_back({slope, curvature, speed, friction, rate, knots});
          }
        }
      }
    }
  }
  const std::size_t of_crate = axes.speeds.size() * axes.frictions.size() * axes.rates.size();
  std::vector<core::Expected<void>> done(cells.size() / of_crate);
  Progress progress("stability of " + std::string(to_text(integrator)), done.size());
  side_by_side(
      done.size(),
      [&](std::size_t i) {
        Cell* const first = &cells[i * of_crate];
        const EggCrate crate =
            egg_crate(first->slope, first->curvature, static_cast<std::size_t>(first->knots_per_wave));
        for (std::size_t k = 0; k < of_crate && done[i]; ++k)
          done[i] = run(first[k], crate, integrator, axes.seconds);
      },
      [&] { progress.advance(); });
  for (const auto& crate : done) {
    if (!crate) return tl::unexpected(crate.error());
  }
  return cells;
}

void add_rows(Table& table, Integrator integrator, const std::vector<Cell>& cells) {
  for (const Cell& c : cells) {
    table.add({std::string(to_text(integrator)), c.slope, c.curvature, c.speed, c.friction, c.rate,
               c.knots_per_wave, c.energy_error, c.gained,
               std::isnan(c.first_nan) ? Table::Cell(std::string()) : Table::Cell(c.first_nan), c.penetration,
               c.capped, c.sub_steps});
  }
}

void summarize(Table& summary, Integrator integrator, const std::vector<Cell>& cells) {
  double nan = 0, capped = 0, within = 0, uncapped = 0, worst = 0, worst_capped = 0, gained = 0,
         gained_capped = 0, through = 0;
  for (const Cell& c : cells) {
    nan += std::isnan(c.first_nan) ? 0 : 1;
    through = std::fmax(through, c.penetration);
    if (c.capped > 0.0) {
      ++capped;
      worst_capped = std::fmax(worst_capped, c.energy_error);
      gained_capped = std::fmax(gained_capped, c.gained);
      continue;
    }
    ++uncapped;
    within += std::isnan(c.first_nan) && c.energy_error <= kGoal ? 1 : 0;
    worst = std::fmax(worst, c.energy_error);
    gained = std::fmax(gained, c.gained);
  }
  summary.add({std::string(to_text(integrator)), static_cast<double>(cells.size()), nan, capped,
               uncapped > 0 ? Table::Cell(100.0 * within / uncapped) : Table::Cell(std::string("-")), worst,
               gained, worst_capped, gained_capped, through});
}

/// One square for each (curvature, speed) and (slope, rate): the worst over frictions and grids.
std::string picture(Integrator integrator, const std::vector<Cell>& cells, const Axes& axes) {
  const std::size_t columns = axes.curvatures.size() * axes.speeds.size();
  const std::size_t rows = axes.slopes.size() * axes.rates.size();
  std::vector<double> worst(columns * rows, 1e-16);
  std::vector<char> touched_cap(columns * rows, 0);
  const auto place = [](const std::vector<double>& axis, double value) {
    return static_cast<std::size_t>(std::find(axis.begin(), axis.end(), value) - axis.begin());
  };
  for (const Cell& c : cells) {
    const std::size_t column =
        place(axes.curvatures, c.curvature) * axes.speeds.size() + place(axes.speeds, c.speed);
    const std::size_t row = place(axes.slopes, c.slope) * axes.rates.size() + place(axes.rates, c.rate);
    double& w = worst[row * columns + column];
    w = std::fmax(w, std::isnan(c.first_nan) ? c.energy_error : 1e300);
    if (c.capped > 0.0) touched_cap[row * columns + column] = 1;
  }
  std::ostringstream map;
  std::ostringstream caps;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double value = std::clamp(std::log10(worst[row * columns + column]), -12.0, 2.0);
      map << column << ' ' << row << ' ' << value << '\n';
      if (touched_cap[row * columns + column] != 0) caps << column << ' ' << row << '\n';
    }
    map << '\n';
  }
  std::ostringstream script;
  script << "$map << EOD\n"
         << map.str() << "EOD\n$caps << EOD\n"
         << caps.str() << "EOD\n"
         << "set title '" << to_text(integrator) << ": energy error in " << axes.seconds
         << " s, worst over friction and grid' noenhanced\n"
         << "set xlabel 'curvature [1/m], speed [m/s]'\nset ylabel 'slope, rate [Hz]'\n"
         << "set cblabel 'log10 of the error (top: not finite); dots: the sub-step cap was reached' "
            "noenhanced offset 1,0\n"
         << "set cbrange [-12:2]\nset palette defined (-12 '#1a6faf', -6 '#7fc4a0', -4 '#f4f0a0', -2 "
            "'#f08030', 0 '#b01020', 2 '#000000')\n"
         << "set xrange [-0.5:" << columns << "-0.5]\nset yrange [-0.5:" << rows
         << "-0.5]\nset tics nomirror out\nset xtics rotate by 60 right (";
  for (std::size_t i = 0; i < columns; ++i) {
    script << (i == 0 ? "" : ",") << '"' << axes.curvatures[i / axes.speeds.size()] << ", "
           << axes.speeds[i % axes.speeds.size()] << "\" " << i;
  }
  script << ")\nset ytics (";
  for (std::size_t i = 0; i < rows; ++i) {
    script << (i == 0 ? "" : ",") << '"' << axes.slopes[i / axes.rates.size()] << ", "
           << axes.rates[i % axes.rates.size()] << "\" " << i;
  }
  script << ")\nplot $map using 1:2:3 with image notitle"
         << (caps.str().empty() ? "" : ", $caps using 1:2 with points pt 7 ps 0.4 lc rgb 'black' notitle")
         << '\n';
  return script.str();
}

core::Expected<void> run_crates(const StabilityOptions& options) {
  std::vector<Integrator> integrators(kIntegrators.begin(), kIntegrators.end());
  if (options.integrator != "all") {
    const auto one = integrator_named(options.integrator);
    if (!one) return tl::unexpected(one.error());
    integrators = {*one};
  }
  const Output& output = options.output;
  const Axes axes = axes_of(output.effort());
  Table table({"integrator", "slope", "curvature", "speed", "friction", "rate", "knots_per_wave",
               "energy_error", "gained", "first_nan", "penetration", "capped", "sub_steps"});
  Table summary({"integrator", "cells", "with_nan", "capped", "percent_within_1e-4", "worst", "gained",
                 "worst_capped", "gained_capped", "penetration"});
  for (const Integrator integrator : integrators) {
    const auto cells = run_all(integrator, axes);
    if (!cells) return tl::unexpected(cells.error());
    add_rows(table, integrator, *cells);
    summarize(summary, integrator, *cells);
    const std::string name = "lab-stability-" + std::string(to_text(integrator));
    if (auto done = output.draw(picture(integrator, *cells, axes), name, 760, 640); !done) return done;
  }
  std::cout << "Egg crates between elastic walls, " << axes.seconds
            << " s a cell; percent, worst: cells that never reached the sub-step cap\n";
  summary.print(std::cout);
  return output.write(table, "lab-stability");
}

core::Expected<void> run(const StabilityOptions& options) {
  const Output& output = options.output;
  const auto wanted = [&](std::string_view part) {
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), part) != options.only.end();
  };
  if (wanted("crates")) {
    if (auto done = run_crates(options); !done) return done;
  }
  if (wanted("maps")) {
    if (auto done = measure_game_stability(options.maps, output); !done) return done;
  }
  if (wanted("soak")) {
    const auto soaked = soak(options.maps, output.effort());
    if (!soaked) return tl::unexpected(soaked.error());
    std::cout << "\nSoak\n";
    soaked->print(std::cout);
    if (auto done = output.write(*soaked, "lab-soak"); !done) return done;
  }
  if (wanted("gains")) {
    const Table gained = gains(output.effort());
    std::cout << "\nEnergy from nothing, of that above the map's lowest place\n";
    gained.print(std::cout);
    if (auto done = output.write(gained, "lab-gains"); !done) return done;
  }
  if (wanted("random")) {
    const std::size_t count = options.random > 0 ? options.random : output.quick ? 20 : 2000;
    if (auto done = measure_stress(count, options.seed, output); !done) return done;
  }
  if (!wanted("rounding")) return {};
  return measure_rounding(output);
}

}  // namespace

void add_stability(CLI::App& app, Job& job) {
  CLI::App* command = app.add_subcommand(
      "stability",
      "Energy, NaN and walls over slopes, curvatures, speeds and rates; a soak; gains by force.");
  const auto options = std::make_shared<StabilityOptions>();
  command->add_option("--integrator", options->integrator, "all, or one of: " + names_of(kIntegrators))
      ->capture_default_str();
  command->add_option("--maps", options->maps, "folder of maps; the project's own when left out")
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--only", options->only,
                   "some of crates,maps,soak,gains,random,rounding; all when left out")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(kParts.begin(), kParts.end())));
  command->add_option("--random", options->random, "how many maps are made by chance");
  command->add_option("--seed", options->seed, "of the first of them; each has the next number")
      ->capture_default_str();
  add_output_options(*command, options->output);
  command->footer(
      "Writes lab-stability.csv and a heat map per integrator, lab-stability-maps.csv and its picture, "
      "lab-soak.csv, "
      "lab-gains.csv, lab-stability-random.csv, lab-rounding.csv and its picture.\n"
      "Example:\n  woodlouse-lab stability --quick --only crates,soak --integrator nystrom4\n"
      "One of the maps that chance made once more:\n  woodlouse-lab stability --only random --random 1 "
      "--seed 7");
  command->callback([options, &job] {
    for (const std::string& part : options->only)
      options->output.command += (&part == &options->only.front() ? " --only " : ",") + part;
    if (options->random > 0) options->output.command += " --random " + std::to_string(options->random);
    if (options->seed != 1) options->output.command += " --seed " + std::to_string(options->seed);
    job = [options] { return run(*options); };
  });
}

}  // namespace woodlouse::lab
