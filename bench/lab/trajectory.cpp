// `trajectory`: the path of one louse, row by row.
#include <cmath>
#include <iostream>
#include <limits>
#include <span>

#include "bench/lab/job.h"
#include "bench/lab/motion.h"
#include "bench/lab/names.h"
#include "bench/lab/numbers.h"
#include "bench/lab/progress.h"
#include "bench/lab/surface_choice.h"
#include "bench/lab/table.h"

namespace woodlouse::lab {
namespace {

struct TrajectoryOptions {
  SurfaceOptions surface;
  std::string equations = "surface";
  std::string integrator = "nystrom4";
  double rate = 60.0;
  double seconds = 10.0;
  std::string state = "0.8,0,0,1.5";
  double gravity = 9.81;
  double drag = 0.0;
  double friction = 0.0;
  std::string thrust = "0,0";
  std::size_t every = 1;
  bool quick = false;
};

void print_row(double t, const terrain::AnySurface& surface, const physics::Louse& louse, double gravity) {
  const terrain::SurfaceSample s = sample_of(surface, louse.position);
  std::cout << exact_text(t);
  for (const double value : {louse.position.x, louse.position.y, s.z, louse.velocity.x, louse.velocity.y,
                             energy_of(s, louse.velocity, gravity)}) {
    std::cout << ',' << exact_text(value);
  }
  std::cout << '\n';
}

core::Expected<physics::Louse> start_of(const TrajectoryOptions& options) {
  const auto state = numbers_of<4>(options.state);
  if (!state) return core::fail("--state", "\"" + options.state + "\" is not x,y,vx,vy", "for example --state 0.8,0,0,1.5");
  const auto thrust = numbers_of<2>(options.thrust);
  if (!thrust) return core::fail("--thrust", "\"" + options.thrust + "\" is not tx,ty", "in m/s^2, for example --thrust 1.5,0");
  physics::Louse louse = louse_at({(*state)[0], (*state)[1]}, {(*state)[2], (*state)[3]});
  push(louse, {(*thrust)[0], (*thrust)[1]});
  return louse;
}

core::Expected<void> run(const TrajectoryOptions& options) {
  const auto surface = make_surface(options.surface);
  if (!surface) return tl::unexpected(surface.error());
  const auto equations = equations_named(options.equations);
  if (!equations) return tl::unexpected(equations.error());
  const auto integrator = integrator_named(options.integrator);
  if (!integrator) return tl::unexpected(integrator.error());
  auto louse = start_of(options);
  if (!louse) return tl::unexpected(louse.error());
  const physics::Parameters parameters{options.gravity, options.drag, options.friction, 1.0, 1.0};
  const auto stepper = physics::make_stepper(*surface, *equations, *integrator, parameters, kNowhere, 1.0 / options.rate);
  if (!stepper) return tl::unexpected(stepper.error());

  const double seconds = options.quick ? std::fmin(options.seconds, 1.0) : options.seconds;
  const auto ticks = static_cast<std::size_t>(std::llround(seconds * options.rate));
  Progress progress("trajectory", ticks);
  physics::StepCounters counters;
  std::cout << "t,x,y,z,vx,vy,energy\n";
  print_row(0.0, *surface, *louse, options.gravity);
  for (std::size_t tick = 1; tick <= ticks; ++tick) {
    (*stepper)->advance(std::span(&*louse, 1), counters);  // a louse at rest stays where it is
    if (tick % options.every == 0) print_row(static_cast<double>(tick) / options.rate, *surface, *louse, options.gravity);
    progress.advance();
  }
  if (!std::cout.flush()) return core::fail("standard output", "can't be written");
  return {};
}

}  // namespace

void add_trajectory(CLI::App& app, Job& job) {
  CLI::App* command = app.add_subcommand("trajectory", "Prints the path of one louse; there are no walls.");
  const auto options = std::make_shared<TrajectoryOptions>();
  TrajectoryOptions& o = *options;
  const CLI::Range any_size(0.0, 1e6);
  add_surface_options(*command, o.surface, MapOption::kOffered);
  command->add_option("--equations", o.equations, names_of(physics::kEquations))->capture_default_str();
  command->add_option("--integrator", o.integrator, names_of(physics::kIntegrators))->capture_default_str();
  command->add_option("--rate", o.rate, "steps a second [Hz]")->check(CLI::Range(1e-3, 1e6))->capture_default_str();
  command->add_option("--seconds", o.seconds, "how long [s]")->check(any_size)->capture_default_str();
  command->add_option("--state", o.state, "x,y,vx,vy [m, m/s]")->capture_default_str();
  command->add_option("--gravity", o.gravity, "[m/s^2]")->check(any_size)->capture_default_str();
  command->add_option("--drag", o.drag, "viscous [1/s]")->check(any_size)->capture_default_str();
  command->add_option("--mu", o.friction, "Coulomb friction [1]")->check(any_size)->capture_default_str();
  command->add_option("--thrust", o.thrust, "tx,ty [m/s^2], a map vector along the tangent, unclamped")->capture_default_str();
  command->add_option("--every", o.every, "print each N-th step")->check(CLI::Range(1, 1000000000))->capture_default_str();
  command->add_flag("--quick", o.quick, "one second at most");
  command->footer(
      "Prints t,x,y,z,vx,vy,energy with 17 digits; energy is kinetic plus potential, per mass. Once at rest, the rows\n"
      "go on.\n"
      "Example:\n  woodlouse-lab trajectory --surface not_a_knot --function wavy_pot --grid 10 --integrator precise "
      "--rate 60 --seconds 2 --state 0.8,0,0,1.5 --every 30");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
}

}  // namespace woodlouse::lab
