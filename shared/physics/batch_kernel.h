// The batched step over a lane type L (core/lanes_*.h); see batch.h. Included only by the files that are
// compiled for one instruction set. Everything here is inlined or depends on L, so that no code that another
// file may share is compiled for it.
#pragma once

#include "shared/physics/batch.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// Samples the spline for all lanes; keeps the cells' coefficients while every lane stays in its cell.
template <typename L>
class LaneSampler {
 public:
  explicit LaneSampler(const terrain::BicubicSpline::View& spline) : spline_(spline) {}

  [[gnu::always_inline]] inline BasicSurfaceSample<L> operator()(Pair<L> x) {
    const L rx = x.x - L(spline_.x_origin);
    const L ry = x.y - L(spline_.y_origin);
    const L i = (rx * L(spline_.inverse_dx)).cell_index(spline_.last_column);
    const L j = (ry * L(spline_.inverse_dy)).cell_index(spline_.last_row);
    const L cell = j * L(spline_.last_column + 1.0) + i;  // exact: far below 2^53
    if (any(cell != cell_)) load(cell);
    return terrain::evaluate_cell(coefficients_, rx - i * L(spline_.dx), ry - j * L(spline_.dy));
  }

 private:
  [[gnu::always_inline]] inline void load(L cell) {
    cell_ = cell;
    double index[L::kCount];
    cell.store(index);
    const double* from[L::kCount];
    for (int part = 0; part < 16; part += L::kCount) {
      for (int l = 0; l < L::kCount; ++l) from[l] = spline_.cells + 16 * static_cast<long long>(index[l]) + part;
      L::load_transposed(from, coefficients_ + part);
    }
  }

  const terrain::BicubicSpline::View& spline_;
  L cell_{-1.0};
  L coefficients_[16];
};

template <typename L, typename F>
unsigned advance_lanes(const BatchContext& context, Louse* const* lice) {
  constexpr int kCount = L::kCount;
  const Parameters& p = context.parameters;
  alignas(64) double in[8][kCount];
  for (int l = 0; l < kCount; ++l) {
    const Louse& louse = *lice[l];
    in[0][l] = louse.position.x;
    in[1][l] = louse.position.y;
    in[2][l] = louse.velocity.x;
    in[3][l] = louse.velocity.y;
    in[7][l] = louse.distance;
    if constexpr (F::thrust) {
      const bool along = louse.thrust_kind == ThrustKind::kAlongHeading;
      in[4][l] = along ? 0.0 : louse.thrust.x;
      in[5][l] = along ? 0.0 : louse.thrust.y;
      in[6][l] = along ? louse.thrust.x : 0.0;
    }
  }
  const BasicMotion<L> start{{L::load(in[0]), L::load(in[1])}, {L::load(in[2]), L::load(in[3])}};
  BasicDrive<L> drive;
  if constexpr (F::thrust) {
    drive = drive_of_map_vector(Pair<L>{L::load(in[4]), L::load(in[5])}, p.thrust_max);
    drive.along = L::load(in[6]) * L(p.thrust_max);
  }

  LaneSampler<L> sample(context.spline);
  const L h(context.tick);
  const BasicSurfaceSample<L> s = sample(start.position);
  const Pair<L> a1 = acceleration<F>(s, start.velocity, drive, p);
  const L speed2 = squared_length_in_space(s, start.velocity);
  auto special = ~(speed2 > L(0.0)) | context.rules.too_long(s, speed2, h);
  if constexpr (F::singular) {
    auto turns = SubStepRules::turns_too_far(squared_length_in_space(s, a1), speed2, h);
    if constexpr (!F::friction) turns = turns & (drive.along != L(0.0));
    special = special | turns;
  }
  const terrain::Rectangle& walls = context.walls;
  const Pair<L> x = start.position;
  special = special | ~((x.x > L(walls.x_min)) & (x.x < L(walls.x_max)) & (x.y > L(walls.y_min)) & (x.y < L(walls.y_max)));

  const BasicMotion<L> end = nystrom4(
      start, a1, h, [&](Pair<L> at) __attribute__((always_inline)) { return sample(at); },
      [&](const BasicSurfaceSample<L>& at, Pair<L> v) __attribute__((always_inline)) { return acceleration<F>(at, v, drive, p); });
  const Pair<L> y = end.position;
  const L way2 = dot(end.velocity, end.velocity);
  const auto inside = (y.x >= L(walls.x_min)) & (y.x <= L(walls.x_max)) & (y.y >= L(walls.y_min)) & (y.y <= L(walls.y_max));
  const unsigned done = (~special & inside & (way2 > L(0.0))).lanes();

  const Pair<L> heading = (L(1.0) / square_root(way2)) * end.velocity;
  const L distance = L::load(in[7]) + h * square_root(speed2);
  alignas(64) double out[7][kCount];
  y.x.store(out[0]);
  y.y.store(out[1]);
  end.velocity.x.store(out[2]);
  end.velocity.y.store(out[3]);
  heading.x.store(out[4]);
  heading.y.store(out[5]);
  distance.store(out[6]);
  for (int l = 0; l < kCount; ++l) {
    if ((done >> l & 1u) == 0) continue;
    Louse& louse = *lice[l];
    louse.position = {out[0][l], out[1][l]};
    louse.velocity = {out[2][l], out[3][l]};
    louse.heading = {out[4][l], out[5][l]};
    louse.distance = out[6][l];
  }
  return done;
}

/// The kernel for a map's forces.
template <typename L>
BatchStep choose_kernel(bool drag, bool friction, bool thrust) {
  constexpr BatchStep kKernels[8] = {
      {L::kCount, advance_lanes<L, Forces<false, false, false>>}, {L::kCount, advance_lanes<L, Forces<false, false, true>>},
      {L::kCount, advance_lanes<L, Forces<false, true, false>>},  {L::kCount, advance_lanes<L, Forces<false, true, true>>},
      {L::kCount, advance_lanes<L, Forces<true, false, false>>},  {L::kCount, advance_lanes<L, Forces<true, false, true>>},
      {L::kCount, advance_lanes<L, Forces<true, true, false>>},   {L::kCount, advance_lanes<L, Forces<true, true, true>>}};
  return kKernels[(drag ? 4 : 0) + (friction ? 2 : 0) + (thrust ? 1 : 0)];
}

}  // namespace woodlouse::physics
