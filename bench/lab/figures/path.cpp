#include "bench/lab/figures/path.h"

#include <cassert>
#include <cmath>

#include "bench/lab/problems/motion.h"

namespace woodlouse::lab {
namespace {

PathPoint point_of(const document::AnySurface& surface, const state::Louse& louse, double t, double gravity) {
  const terrain::SurfaceSample s = sample_of(surface, louse.position);
  return {t, louse.position, s.z, louse.velocity, energy_of(s, louse.velocity, gravity)};
}

}  // namespace

core::Expected<std::vector<PathPoint>> path_over(const document::AnySurface& surface,
                                                 const PathMethod& method,
                                                 const state::Parameters& parameters,
                                                 const Journey& journey) {
  assert(method.steps_a_point >= 1 && journey.rate > 0.0);
  const double tick = 1.0 / (journey.rate * static_cast<double>(method.steps_a_point));
  const auto stepper = make_stepper(surface, method.equations, method.integrator, parameters, kNowhere, tick);
  if (!stepper) return tl::unexpected(stepper.error());
  state::Louse louse = louse_at(journey.from, journey.velocity);
  physics::StepCounters counters;
  std::vector<PathPoint> path = {point_of(surface, louse, 0.0, parameters.gravity)};
  const auto points = static_cast<std::size_t>(std::llround(journey.seconds * journey.rate));
  for (std::size_t i = 1; i <= points; ++i) {
    for (std::size_t step = 0; step < method.steps_a_point; ++step)
      (*stepper)->advance({&louse, 1}, counters);  // a louse at rest stays where it is
    path.push_back(point_of(surface, louse, static_cast<double>(i) / journey.rate, parameters.gravity));
  }
  return path;
}

}  // namespace woodlouse::lab
