// The energy of lanes (bounded_energy.h, energy_projection.h). Under the rules of kernel.h.
#pragma once

#include "shared/physics/batch.h"
#include "shared/physics/energy_projection.h"
#include "shared/physics/lanes/batch.h"

namespace woodlouse::physics {

/// Who may have gained energy. Its samples, which the others do without, are taken anew.
template <typename L, typename F, typename G>
[[gnu::noinline]] typename L::Mask gains_too_much(const LaneBatch<L, F, G>& batch, const G& ground,
                                                  const BatchContext& context) {
  const auto sample = [&](Pair<L> x) {
    typename G::Place place;
    ground.locate(x, place);
    return ground.sample(place);
  };
  const L h = batch.h;
  const Pair<L> x = batch.start.position, last = nystrom_last(batch.start, batch.a3, h);
  const auto s = sample(x);
  L push(0.0), fallen(0.0);
  if constexpr (F::thrust) push = batch.drive.force.push;
  if constexpr (F::central) fallen = -batch.climbed(context.parameters);
  const auto gain =
      energy_gain(s.z, squared_length_in_space(s, batch.start.velocity), batch.end.position - x, sample(last),
                  batch.end.position - last, batch.end.velocity, h, context.parameters.gravity, push, fallen);
  return ~(gain.energy <= context.rules.bearable_gain(h) * gain.kinetic);
}

/// Brings the ends of who has no thrust to the energy of the start.
template <typename L, typename F, typename G>
[[gnu::always_inline]] inline void keep_energy(LaneBatch<L, F, G>& batch, const state::Parameters& p) {
  const auto kept = [&]() __attribute__((always_inline)) {
    if constexpr (F::central) {
      return with_energy<true>(batch.energy, batch.s, batch.end, batch.h, p.gravity, batch.climbed(p),
                               batch.drive.force.pull);
    } else {
      return with_energy(batch.energy, batch.s, batch.end, batch.h, p.gravity);
    }
  }
  ();
  if constexpr (F::thrust) {
    const auto is_idle = batch.idle();
    const auto choose = [&](Pair<L> a, Pair<L> b) __attribute__((always_inline)) {
      return Pair<L>{core::select(is_idle, a.x, b.x), core::select(is_idle, a.y, b.y)};
    };
    batch.end = {choose(kept.end.position, batch.end.position),
                 choose(kept.end.velocity, batch.end.velocity)};
    batch.special |= (is_idle & ~kept.near).lanes();
  } else {
    batch.end = kept.end;
    batch.special |= (~kept.near).lanes();
  }
}

}  // namespace woodlouse::physics
