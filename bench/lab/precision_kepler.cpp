#include "bench/lab/precision_kepler.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "bench/lab/methods/laboratory.h"
#include "bench/lab/problems/flat_ground.h"
#include "bench/lab/problems/kepler_ellipse.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/race.h"
#include "bench/lab/report/work_precision.h"
#include "shared/physics/central_gravity.h"

namespace woodlouse::lab {
namespace {

constexpr double kPull = 1.0;  // the document's planet: F = -x / r^3
constexpr double kPeriods = 10.0;
constexpr double kManyPeriods = 100.0;

state::Parameters planet() {
  state::Parameters p{0.0, 0.0, 0.0, 0.0, 1.0};
  p.central_gravity = kPull;
  p.core_radius = physics::default_core_radius(kPull);
  return p;
}

struct Measured {
  double sub_steps = 0.0;
  double position = 0.0;                    ///< error after kPeriods
  double energy = 0.0, energy_later = 0.0;  ///< largest relative error within kPeriods, within kManyPeriods
  double momentum_later = 0.0;
};

Measured measure(const LaboratoryStepper& stepper, const KeplerEllipse& ellipse, double rate) {
  Measured result;
  state::Louse louse = louse_at(ellipse.start(), ellipse.velocity());
  physics::StepCounters counters;
  const double momentum = KeplerEllipse::angular_momentum(louse.position, louse.velocity);
  const long ticks = std::lround(kPeriods * ellipse.period() * rate);
  const long many = std::lround(kManyPeriods * ellipse.period() * rate);
  for (long tick = 1; tick <= many; ++tick) {
    stepper.advance({&louse, 1}, counters);
    const double energy = std::fabs(ellipse.energy(louse.position, louse.velocity) / ellipse.energy() - 1.0);
    result.energy_later = std::max(result.energy_later, energy);
    result.momentum_later =
        std::max(result.momentum_later,
                 std::fabs(KeplerEllipse::angular_momentum(louse.position, louse.velocity) / momentum - 1.0));
    if (tick != ticks) continue;
    result.energy = result.energy_later;
    result.position = distance(louse.position, ellipse.position_at(static_cast<double>(tick) / rate));
  }
  result.sub_steps = static_cast<double>(counters.sub_steps) / static_cast<double>(counters.louse_steps);
  return result;
}

/// One period, over and over.
Contestant runner(std::shared_ptr<const LaboratoryStepper> stepper, const KeplerEllipse& ellipse,
                  double rate) {
  const long ticks = std::lround(ellipse.period() * rate);
  const auto run = [stepper = std::move(stepper), start = louse_at(ellipse.start(), ellipse.velocity()),
                    ticks] {
    physics::StepCounters counters;
    state::Louse louse = start;
    for (long tick = 0; tick < ticks; ++tick) stepper->advance({&louse, 1}, counters);
    keep(louse);
  };
  return {"", run, static_cast<double>(ticks) / rate};
}

}  // namespace

core::Expected<void> measure_kepler(const Output& output) {
  const std::vector<double> rates =
      output.quick ? std::vector<double>{60, 240} : std::vector<double>{15, 30, 60, 120, 240, 480, 960};
  const document::AnySurface ground = flat_ground();
  Table table({"eccentricity", "integrator", "rate", "sub_steps", "ns_per_second", "ns_best",
               "error_10_periods", "energy_10_periods", "energy_100_periods", "momentum_100_periods"});
  std::vector<Panel> panels;
  for (const double speed : {0.8, 0.4}) {
    const KeplerEllipse ellipse(kPull, 1.0, speed);
    const std::string name = "eccentricity " + short_text(ellipse.eccentricity());
    std::vector<Measured> measured;
    std::vector<Contestant> contestants;
    {
      Progress progress("errors, " + name, kIntegrators.size() * rates.size());
      for (const Integrator integrator : kIntegrators) {
        for (const double rate : rates) {
          auto made = make_stepper(ground, Equations::kSurface, integrator, planet(), kNowhere, 1.0 / rate);
          if (!made) return tl::unexpected(made.error());
          const std::shared_ptr<const LaboratoryStepper> stepper = std::move(*made);
          measured.push_back(measure(*stepper, ellipse, rate));
          contestants.push_back(runner(stepper, ellipse, rate));
          progress.advance();
        }
      }
    }
    const std::vector<Timing> times = race(contestants, output.effort(), "times, " + name);
    Panel panel{name, "position error after 10 periods [m]", {}};
    std::size_t i = 0;
    for (const Integrator integrator : kIntegrators) {
      Curve curve{std::string(to_text(integrator)), {}};
      for (const double rate : rates) {
        const Measured& m = measured[i];
        table.add({ellipse.eccentricity(), curve.name, rate, m.sub_steps, times[i].median_ns,
                   times[i].best_ns, m.position, m.energy, m.energy_later, m.momentum_later});
        curve.points.emplace_back(times[i].median_ns, m.position);
        ++i;
      }
      panel.curves.push_back(std::move(curve));
    }
    panels.push_back(std::move(panel));
  }
  std::cout << "\nCentral gravity, k = " << kPull
            << " m^3/s^2, from (1, 0) m at (0, 0.8) and (0, 0.4) m/s on flat ground; energy and "
            << "momentum: the largest relative error at a tick\n";
  table.print(std::cout);
  if (auto done = output.write(table, "lab-precision-kepler"); !done) return done;
  return output.draw(work_precision_picture(panels), "lab-precision-kepler", 1000, 560);
}

}  // namespace woodlouse::lab
