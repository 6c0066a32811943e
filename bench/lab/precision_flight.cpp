#include "bench/lab/precision_flight.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bench/lab/methods/laboratory.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/problems/ski_jump.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/race.h"
#include "bench/lab/report/work_precision.h"

namespace woodlouse::lab {
namespace {

using SharedStepper = std::shared_ptr<const LaboratoryStepper>;

constexpr double kSeconds =
    1.6;  // a whole number of ticks at every rate, a third of a second after the landings

core::Expected<SharedStepper> jumping(const document::AnySurface& ground, Integrator integrator,
                                      double tick) {
  state::Parameters p{SkiJump::kGravity, 0.0, 0.0, 0.0, 1.0};
  p.contact = state::SurfaceContact::kUnilateral;
  auto stepper = make_stepper(ground, Equations::kSurface, integrator, p, kNowhere, tick);
  if (!stepper) return tl::unexpected(stepper.error());
  return SharedStepper(std::move(*stepper));
}

std::vector<Jump> jumps() {
  return {Jump({-1.3, 0.5}, 2.2, -0.6), Jump({-1.7, -1.0}, 2.4, 0.4), Jump({-1.1, 0.0}, 2.6, 0.0),
          Jump({-1.45, 1.0}, 2.8, 0.3), Jump({-1.57, -0.3}, 3.0, -0.2)};
}

struct Landing {
  double time;
  core::Vec2 place;
};

/// Where the parabola that a flying louse is on meets the ground, in the closed form of both.
Landing landing_of(const state::Louse& louse, double now, double within) {
  double low = 0.0, high = within;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.5 * (low + high);
    const double height = louse.flight_z + t * louse.flight_vz - 0.5 * SkiJump::kGravity * t * t;
    (height > SkiJump::ground(louse.position.x + t * louse.velocity.x).z ? low : high) = t;
  }
  return {now + high, louse.position + high * louse.velocity};
}

/// The shortest tick in which `before` takes off, given that it does in `tick`.
core::Expected<double> take_off_after(const document::AnySurface& ground, Integrator integrator,
                                      const state::Louse& before, double tick) {
  double low = 0.0, high = tick;
  for (int i = 0; i < 44; ++i) {
    const double middle = 0.5 * (low + high);
    const auto stepper = jumping(ground, integrator, middle);
    if (!stepper) return tl::unexpected(stepper.error());
    state::Louse louse = before;
    physics::StepCounters counters;
    (*stepper)->advance({&louse, 1}, counters);
    (counters.flights > 0 ? high : low) = middle;
  }
  return high;
}

/// The largest errors of all jumps.
struct Measured {
  double sub_steps = 0.0, flights = 0.0;
  double take_off = 0.0, landing_time = 0.0, landing_place = 0.0, end = 0.0;
};

core::Expected<Measured> measure(const document::AnySurface& ground, Integrator integrator, double rate,
                                 const std::vector<Jump>& all) {
  const auto stepper = jumping(ground, integrator, 1.0 / rate);
  if (!stepper) return tl::unexpected(stepper.error());
  Measured worst;
  physics::StepCounters counters;
  for (const Jump& jump : all) {
    state::Louse louse = louse_at(jump.start(), jump.velocity());
    std::optional<double> take_off;
    std::optional<Landing> landing;
    for (long tick = 1; tick <= std::lround(kSeconds * rate); ++tick) {
      const state::Louse before = louse;
      (*stepper)->advance({&louse, 1}, counters);
      if (louse.phase != state::Phase::kFlying) continue;
      const double now = static_cast<double>(tick) / rate;
      if (!take_off) {
        const auto after = take_off_after(ground, integrator, before, 1.0 / rate);
        if (!after) return tl::unexpected(after.error());
        take_off = now - 1.0 / rate + *after;
      }
      landing = landing_of(louse, now, kSeconds);
    }
    if (!take_off) {  // it never flew: it has no such errors
      worst.take_off = worst.landing_time = worst.landing_place = std::numeric_limits<double>::infinity();
    } else {
      worst.take_off = std::max(worst.take_off, std::fabs(*take_off - jump.take_off()));
      worst.landing_time = std::max(worst.landing_time, std::fabs(landing->time - jump.landing()));
      worst.landing_place = std::max(worst.landing_place, distance(landing->place, jump.landing_place()));
    }
    worst.end = std::max(worst.end, distance(louse.position, jump.place_after(kSeconds)));
  }
  worst.sub_steps = static_cast<double>(counters.sub_steps) / static_cast<double>(counters.louse_steps);
  worst.flights = static_cast<double>(counters.flights) / static_cast<double>(all.size());
  return worst;
}

Contestant runner(SharedStepper stepper, double rate, const std::vector<Jump>& all) {
  const long ticks = std::lround(kSeconds * rate);
  const auto run = [stepper = std::move(stepper), &all, ticks] {
    physics::StepCounters counters;
    for (const Jump& jump : all) {
      state::Louse louse = louse_at(jump.start(), jump.velocity());
      for (long tick = 0; tick < ticks; ++tick) stepper->advance({&louse, 1}, counters);
      keep(louse);
    }
  };
  return {"", run, kSeconds * static_cast<double>(all.size())};
}

}  // namespace

core::Expected<void> measure_flight(const Output& output) {
  const std::vector<double> rates =
      output.quick ? std::vector<double>{60, 240} : std::vector<double>{15, 30, 60, 120, 240, 480, 960};
  const document::AnySurface ground = SkiJump::spline();
  const std::vector<Jump> all = jumps();
  std::vector<Measured> measured;
  std::vector<Contestant> contestants;
  {
    Progress progress("errors of jumps", kIntegrators.size() * rates.size());
    for (const Integrator integrator : kIntegrators) {
      for (const double rate : rates) {
        const auto one = measure(ground, integrator, rate, all);
        if (!one) return tl::unexpected(one.error());
        auto stepper = jumping(ground, integrator, 1.0 / rate);
        if (!stepper) return tl::unexpected(stepper.error());
        measured.push_back(*one);
        contestants.push_back(runner(std::move(*stepper), rate, all));
        progress.advance();
      }
    }
  }
  const std::vector<Timing> times = race(contestants, output.effort(), "times of jumps");
  Table table({"integrator", "rate", "sub_steps", "flights", "ns_per_second", "ns_best", "take_off_time",
               "landing_time", "landing_place", "error_after"});
  Panel in_flight{"landing", "error of the place of landing [m]", {}};
  Panel after{"a third of a second after it", "position error [m]", {}};
  std::size_t i = 0;
  for (const Integrator integrator : kIntegrators) {
    const std::string name(to_text(integrator));
    Curve landing{name, {}}, end{name, {}};
    for (const double rate : rates) {
      const Measured& m = measured[i];
      table.add({name, rate, m.sub_steps, m.flights, times[i].median_ns, times[i].best_ns, m.take_off,
                 m.landing_time, m.landing_place, m.end});
      landing.points.emplace_back(times[i].median_ns, m.landing_place);
      end.points.emplace_back(times[i].median_ns, m.end);
      ++i;
    }
    in_flight.curves.push_back(std::move(landing));
    after.curves.push_back(std::move(end));
  }
  std::cout << "\nFlight: " << all.size() << " jumps over an edge of known curve, " << kSeconds
            << " s; the largest errors of time [s] and place [m]; inf: one did not fly\n";
  table.print(std::cout);
  if (auto done = output.write(table, "lab-precision-flight"); !done) return done;
  return output.draw(work_precision_picture({in_flight, after}), "lab-precision-flight", 1000, 560);
}

}  // namespace woodlouse::lab
