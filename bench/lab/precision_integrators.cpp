#include "bench/lab/precision_integrators.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "bench/lab/methods/constrained.h"
#include "bench/lab/methods/laboratory.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/problems/reference_motion.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/race.h"
#include "bench/lab/report/work_precision.h"
#include "shared/core/random.h"

namespace woodlouse::lab {
namespace {

constexpr double kSeconds = 10.0;

struct Ground {
  std::string name;
  document::AnySurface surface;
};

/// Gravity and curvature alone: the hardest case for energy and phase, and one with a reference to 1e-13.
state::Parameters free_motion() { return {9.81, 0.0, 0.0, 0.0, 1.0}; }

/// Where and how fast the measured lice start: well inside, at speeds that keep them there.
std::vector<physics::Motion> starts(Effort effort) {
  core::Random random(3);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  std::vector<physics::Motion> result{{{0.8, 0.0}, {0.0, 1.5}}};
  const std::size_t count = effort == Effort::kQuick ? 3 : 9;
  while (result.size() < count)
    result.push_back({{symmetric(0.6), symmetric(0.6)}, {symmetric(1.0), symmetric(1.0)}});
  return result;
}

std::vector<Ground> grounds(terrain::FunctionName function) {
  std::vector<Ground> result;
  result.push_back({"function", terrain::FunctionSurface(function, 1.0)});
  for (const std::size_t grid : {10u, 100u}) {
    result.push_back({"spline " + std::to_string(2 * grid + 1),
                      terrain::BicubicSpline(terrain::sample_function(function, 1.0, grid))});
  }
  return result;
}

physics::Motion reference_end(const document::AnySurface& surface, const physics::Motion& start, double h) {
  if (const auto* spline = std::get_if<terrain::BicubicSpline>(&surface)) {
    return reference_motion(*spline, start, kSeconds, h, free_motion());
  }
  return reference_motion(std::get<terrain::FunctionSurface>(surface), start, kSeconds, h, free_motion());
}

struct Measured {
  std::string method;
  double rate;
  double median_error, worst_error, sub_steps;
};

Measured judged(std::string method, double rate, double sub_steps, const std::vector<core::Vec2>& places,
                const std::vector<physics::Motion>& ends) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double error = distance(places[i], ends[i].position);
    errors.push_back(std::isfinite(error) ? error : 1e300);
  }
  std::sort(errors.begin(), errors.end());
  return {std::move(method), rate, errors[errors.size() / 2], errors.back(), sub_steps};
}

/// The errors after kSeconds of all starts.
core::Expected<Measured> measure(const Ground& ground, Integrator integrator, double rate,
                                 const std::vector<physics::Motion>& from,
                                 const std::vector<physics::Motion>& ends) {
  const auto stepper =
      make_stepper(ground.surface, Equations::kSurface, integrator, free_motion(), kNowhere, 1.0 / rate);
  if (!stepper) return tl::unexpected(stepper.error());
  std::vector<core::Vec2> places;
  physics::StepCounters counters;
  for (std::size_t i = 0; i < from.size(); ++i) {
    state::Louse louse = louse_at(from[i].position, from[i].velocity);
    for (long tick = 0; tick < std::lround(kSeconds * rate); ++tick)
      (*stepper)->advance({&louse, 1}, counters);
    places.push_back(louse.position);
  }
  return judged(std::string(to_text(integrator)), rate,
                static_cast<double>(counters.sub_steps) / static_cast<double>(counters.louse_steps), places,
                ends);
}

Measured measure(const Ground& ground, Constrained method, double rate,
                 const std::vector<physics::Motion>& from, const std::vector<physics::Motion>& ends) {
  std::vector<core::Vec2> places;
  for (const physics::Motion& start : from) {
    const auto motion = make_constrained(ground.surface, method, free_motion().gravity, start, 1.0 / rate);
    for (long tick = 0; tick < std::lround(kSeconds * rate); ++tick) motion->step();
    places.push_back(motion->position());
  }
  return judged(std::string(to_text(method)), rate, 1.0, places, ends);
}

/// One simulated second of all starts, over and over.
core::Expected<Contestant> runner(const Ground& ground, Integrator integrator, double rate,
                                  const std::vector<physics::Motion>& from) {
  auto stepper =
      make_stepper(ground.surface, Equations::kSurface, integrator, free_motion(), kNowhere, 1.0 / rate);
  if (!stepper) return tl::unexpected(stepper.error());
  const auto run = [shared = std::shared_ptr<const LaboratoryStepper>(std::move(*stepper)), &from,
                    ticks = std::lround(rate)] {
    physics::StepCounters counters;
    for (const physics::Motion& start : from) {
      state::Louse louse = louse_at(start.position, start.velocity);
      for (long tick = 0; tick < ticks; ++tick) shared->advance({&louse, 1}, counters);
      keep(louse);
    }
  };
  return Contestant{std::string(to_text(integrator)), run, static_cast<double>(from.size())};
}

/// The same, each second behind the one before: nobody begins anew in a game.
Contestant runner(const Ground& ground, Constrained method, double rate,
                  const std::vector<physics::Motion>& from) {
  std::vector<std::shared_ptr<ConstrainedMotion>> motions;
  for (const physics::Motion& start : from)
    motions.push_back(make_constrained(ground.surface, method, free_motion().gravity, start, 1.0 / rate));
  const auto run = [motions = std::move(motions), ticks = std::lround(rate)] {
    for (const auto& motion : motions) {
      for (long tick = 0; tick < ticks; ++tick) motion->step();
      keep(motion->position());
    }
  };
  return Contestant{std::string(to_text(method)), run, static_cast<double>(from.size())};
}

std::vector<std::string> names_of_methods() {
  std::vector<std::string> names;
  for (const Integrator integrator : kIntegrators) names.emplace_back(to_text(integrator));
  for (const Constrained method : kConstrained) names.emplace_back(to_text(method));
  return names;
}

std::string picture(const Table& table, const std::vector<Ground>& all) {
  std::vector<Panel> panels;
  for (const Ground& ground : all) {
    Panel panel{ground.name, "position error after 10 s [m]", {}};
    for (const std::string& name : names_of_methods()) {
      Curve curve{name, {}};
      for (const auto& row : table.rows()) {
        if (std::get<std::string>(row[0]) != ground.name || std::get<std::string>(row[1]) != curve.name)
          continue;
        curve.points.emplace_back(std::get<double>(row[4]), std::get<double>(row[6]));
      }
      panel.curves.push_back(std::move(curve));
    }
    panels.push_back(std::move(panel));
  }
  return work_precision_picture(panels);
}

}  // namespace

core::Expected<void> measure_integrators(terrain::FunctionName function, const Output& output) {
  const Effort effort = output.effort();
  const std::vector<Ground> all = grounds(function);
  const std::vector<physics::Motion> from = starts(effort);
  const std::vector<double> rates = effort == Effort::kQuick
                                        ? std::vector<double>{60, 240}
                                        : std::vector<double>{15, 30, 60, 120, 240, 480, 960};
  const double h = effort == Effort::kQuick ? 1.0 / 1000 : 1.0 / 2000;
  Table table({"surface", "integrator", "rate", "sub_steps", "ns_per_second", "ns_best", "error_median",
               "error_worst", "reference_uncertainty"});
  for (const Ground& ground : all) {
    std::vector<physics::Motion> ends;
    double uncertainty = 0.0;
    {
      Progress progress("reference on " + ground.name, from.size());
      for (const physics::Motion& start : from) {
        ends.push_back(reference_end(ground.surface, start, h));
        uncertainty = std::fmax(uncertainty, distance(ends.back().position,
                                                      reference_end(ground.surface, start, 2 * h).position));
        progress.advance();
      }
    }
    std::vector<Measured> measured;
    std::vector<Contestant> contestants;
    {
      Progress progress("errors on " + ground.name,
                        (kIntegrators.size() + kConstrained.size()) * rates.size());
      for (const Integrator integrator : kIntegrators) {
        for (const double rate : rates) {
          auto one = measure(ground, integrator, rate, from, ends);
          if (!one) return tl::unexpected(one.error());
          auto contestant = runner(ground, integrator, rate, from);
          if (!contestant) return tl::unexpected(contestant.error());
          measured.push_back(std::move(*one));
          contestants.push_back(std::move(*contestant));
          progress.advance();
        }
      }
      for (const Constrained method : kConstrained) {
        for (const double rate : rates) {
          measured.push_back(measure(ground, method, rate, from, ends));
          contestants.push_back(runner(ground, method, rate, from));
          progress.advance();
        }
      }
    }
    const std::vector<Timing> times = race(contestants, effort, "times on " + ground.name);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const Measured& m = measured[i];
      table.add({ground.name, m.method, m.rate, m.sub_steps, times[i].median_ns, times[i].best_ns,
                 m.median_error, m.worst_error, uncertainty});
    }
  }
  std::cout << "Integrators on " << to_text(function) << ", gravity and curvature alone, " << kSeconds
            << " s, " << from.size()
            << " starts; reference_uncertainty: what halving the reference's step changes\n";
  table.print(std::cout);
  if (auto done = output.write(table, "lab-precision-integrators"); !done) return done;
  return output.draw(picture(table, all), "lab-precision-integrators", 1500, 560);
}

}  // namespace woodlouse::lab
