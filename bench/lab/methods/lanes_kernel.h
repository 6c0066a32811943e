// lanes.h over a lane type L. Included only by the files that are compiled for one instruction set.
#pragma once

#include "bench/lab/methods/lanes.h"
#include "shared/physics/lanes/kernel.h"

namespace woodlouse::lab {

template <typename L>
double sum_of_lanes(const terrain::BicubicSpline::View& spline, const double* x, const double* y,
                    std::size_t n) {
  const physics::SplineLanes<L> ground(spline);
  typename physics::SplineLanes<L>::Place place;
  L total(0.0);
  for (std::size_t i = 0; i < n; i += static_cast<std::size_t>(L::kCount)) {
    ground.locate(core::Pair<L>{L::load(x + i), L::load(y + i)}, place);
    const terrain::BasicSurfaceSample<L> s = ground.sample(place);
    total = total + ((s.z + s.zx + s.zy) + (s.zxx + s.zxy + s.zyy));
  }
  double lanes[L::kCount];
  total.store(lanes);
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

}  // namespace woodlouse::lab
