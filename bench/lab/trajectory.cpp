// `trajectory`: the path of one louse, row by row.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <limits>
#include <span>

#include "bench/lab/job.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/problems/names.h"
#include "bench/lab/problems/surface_choice.h"
#include "bench/lab/report/numbers.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/table.h"
#include "shared/physics/central_gravity.h"

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
  double central_gravity = 0.0;
  std::string contact = "bilateral";
  std::string thrust = "0,0";
  std::size_t every = 1;
  bool quick = false;
};

void print_row(double t, const document::AnySurface& surface, const state::Louse& louse,
               const state::Parameters& parameters) {
  const core::Vec2 v = louse.velocity;
  const bool flies = louse.phase == state::Phase::kFlying;
  const terrain::SurfaceSample s = sample_of(surface, louse.position);
  const double z = flies ? louse.flight_z : s.z;
  double energy = flies ? 0.5 * (dot(v, v) + louse.flight_vz * louse.flight_vz) + parameters.gravity * z
                        : energy_of(s, v, parameters.gravity);
  if (parameters.central_gravity > 0.0) energy += physics::central_potential(louse.position, parameters);
  std::cout << exact_text(t);
  for (const double value : {louse.position.x, louse.position.y, z, v.x, v.y, energy})
    std::cout << ',' << exact_text(value);
  std::cout << '\n';
}

/// What only the exact equations have, and what does not go together.
core::Expected<state::Parameters> parameters_of(const TrajectoryOptions& options, const state::Louse& louse,
                                                Equations equations) {
  const auto contact = contact_named(options.contact);
  if (!contact) return tl::unexpected(contact.error());
  const double thrust_max =
      louse.thrust_kind == state::ThrustKind::kNone ? 0.0 : 1.0;  // without any, energy is kept
  state::Parameters parameters{options.gravity, options.drag, options.friction, thrust_max, 1.0};
  parameters.contact = *contact;
  parameters.central_gravity = options.central_gravity;
  if (options.central_gravity > 0.0)
    parameters.core_radius = physics::default_core_radius(options.central_gravity);
  const bool flies = *contact == state::SurfaceContact::kUnilateral;
  if (equations != Equations::kSurface && (flies || options.central_gravity > 0.0)) {
    return core::fail("--equations", "the document's have neither flight nor central gravity",
                      "take --equations surface");
  }
  if (flies && options.central_gravity > 0.0) {
    return core::fail("--contact", "a flight's parabola knows no central gravity", "take one of the two");
  }
  return parameters;
}

core::Expected<state::Louse> start_of(const TrajectoryOptions& options) {
  const auto state = numbers_of<4>(options.state);
  if (!state)
    return core::fail("--state", "\"" + options.state + "\" is not x,y,vx,vy",
                      "for example --state 0.8,0,0,1.5");
  const auto thrust = numbers_of<2>(options.thrust);
  if (!thrust)
    return core::fail("--thrust", "\"" + options.thrust + "\" is not tx,ty",
                      "in m/s^2, for example --thrust 1.5,0");
  state::Louse louse = louse_at({(*state)[0], (*state)[1]}, {(*state)[2], (*state)[3]});
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
  const auto parameters = parameters_of(options, *louse, *equations);
  if (!parameters) return tl::unexpected(parameters.error());
  const auto stepper =
      make_stepper(*surface, *equations, *integrator, *parameters, kNowhere, 1.0 / options.rate);
  if (!stepper) return tl::unexpected(stepper.error());

  const double seconds = options.quick ? std::fmin(options.seconds, 1.0) : options.seconds;
  const auto ticks = static_cast<std::size_t>(std::llround(seconds * options.rate));
  Progress progress("trajectory", ticks);
  physics::StepCounters counters;
  std::cout << "t,x,y,z,vx,vy,energy\n";
  print_row(0.0, *surface, *louse, *parameters);
  for (std::size_t tick = 1; tick <= ticks; ++tick) {
    (*stepper)->advance(std::span(&*louse, 1), counters);  // a louse at rest stays where it is
    if (tick % options.every == 0)
      print_row(static_cast<double>(tick) / options.rate, *surface, *louse, *parameters);
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
  command->add_option("--equations", o.equations, names_of(kEquations))->capture_default_str();
  command->add_option("--integrator", o.integrator, names_of(kIntegrators))->capture_default_str();
  command->add_option("--rate", o.rate, "steps a second [Hz]")
      ->check(CLI::Range(1e-3, 1e6))
      ->capture_default_str();
  command->add_option("--seconds", o.seconds, "how long [s]")->check(any_size)->capture_default_str();
  command->add_option("--state", o.state, "x,y,vx,vy [m, m/s]")->capture_default_str();
  command->add_option("--gravity", o.gravity, "[m/s^2]")->check(any_size)->capture_default_str();
  command->add_option("--drag", o.drag, "viscous [1/s]")->check(any_size)->capture_default_str();
  command->add_option("--mu", o.friction, "Coulomb friction [1]")->check(any_size)->capture_default_str();
  command->add_option("--central-gravity", o.central_gravity, "pull towards the origin, k / r^2 [m^3/s^2]")
      ->check(any_size)
      ->capture_default_str();
  command
      ->add_option("--contact", o.contact,
                   names_of(kContacts) + "; unilateral: where it would be pulled to the ground, it flies")
      ->capture_default_str();
  command->add_option("--thrust", o.thrust, "tx,ty [m/s^2], a map vector along the tangent, unclamped")
      ->capture_default_str();
  command->add_option("--every", o.every, "print each N-th step")
      ->check(CLI::Range(1, 1000000000))
      ->capture_default_str();
  command->add_flag("--quick", o.quick, "one second at most");
  command->footer(
      "Prints t,x,y,z,vx,vy,energy with 17 digits; energy is kinetic plus potential, per mass. Once at rest, "
      "the rows\n"
      "go on. In flight, z is the louse's own height.\n"
      "Example:\n  woodlouse-lab trajectory --surface not_a_knot --function wavy_pot --grid 10 --integrator "
      "precise "
      "--rate 60 --seconds 2 --state 0.8,0,0,1.5 --every 30\n"
      "  woodlouse-lab trajectory --surface function --function hills --contact unilateral --state 0.4,0,4,0 "
      "--seconds 0.5");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
}

}  // namespace woodlouse::lab
