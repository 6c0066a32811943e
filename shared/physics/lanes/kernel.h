// The batched step over a lane type L (core/lanes_*.h); see batch.h. Included only by the files that are
// compiled for one instruction set. Everything here is inlined or depends on L, so that no code that another
// file may share is compiled for it.
//
// A step is one long chain of operations that wait for each other: four accelerations and three samples. So a
// block of lice goes through it stage by stage, the state between two stages in a few arrays that stay in the
// nearest cache: within a stage the lice do not wait for each other, and the processor works on several at a
// time.
//     load      fields of the lice, their drives; finds their cells and asks the memory for them
//     sample, a1; the sub-step h; x2 and its cell
//     sample, a2, a3; x4 and its cell
//     sample, a4; the end, its gain of energy; where energy is kept, its sample and projection
//     write back what is done
// Who has not used up the tick goes through again, with others of that kind.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shared/physics/batch.h"
#include "shared/physics/energy_projection.h"
#include "shared/physics/integrators.h"
#include "shared/physics/lanes/drives.h"
#include "shared/physics/lanes/fields.h"
#include "shared/physics/lanes/grounds.h"
#include "shared/physics/nystrom.h"

namespace woodlouse::physics {

/// L: the lanes; F: the Forces the map has; G: its ground (grounds.h).
template <typename L, typename F, typename G>
class LaneStepper {
 public:
  explicit LaneStepper(const BatchContext& context)
      : context_(context),
        ground_(context),
        shortest_(context.rules.shortest()),
        keeps_energy_(kMayKeepEnergy && conserves_energy(context.parameters)) {}

  /// See BatchStep.
  void advance(state::Louse* lice, std::span<const std::uint32_t> moving, BatchLists& lists,
               StepCounters& counters) {
    lists.left.clear();
    lists.again.clear();
    run(
        lice, moving.size(),
        [&](std::size_t i) {
          return LouseTick{moving[i], 0, context_.tick};
        },
        lists, counters);
    while (!lists.again.empty()) {
      lists.now.swap(lists.again);
      lists.again.clear();
      run(
          lice, lists.now.size(), [&](std::size_t i) { return lists.now[i]; }, lists, counters);
    }
  }

 private:
  static constexpr std::size_t kCount = L::kCount;
  static constexpr std::size_t kBlock = 32;
  static constexpr std::size_t kBatches = kBlock / kCount;
  static constexpr auto kMaxPieces = static_cast<std::uint32_t>(kMaxSubSteps);
  static constexpr std::size_t kSamples = Nystrom4::kSamples + 1;  // with the start's
  static constexpr bool kMayKeepEnergy =
      !F::friction && (!F::drag || F::any_drag) && terrain::Curved<typename G::Sample>;

  /// What a batch hands from stage to stage.
  struct Batch {
    BasicMotion<L> start;
    LaneDrive<L> drive;
    typename G::Place place;
    typename G::Sample s;
    Pair<L> w;  ///< velocity of the stage
    Pair<L> a1, a2, a3, a4, thrust;
    L h, way, remaining;
    L energy;  ///< at the start; only where it is kept
    BasicMotion<L> end;
    unsigned active;  ///< lanes that hold a louse
    unsigned special;
    unsigned finished;
    state::Louse* lice[kCount];
    alignas(64) double after[kCount];
  };

  /// One sub-step for each of `count` lice; tick_of(i): who and how far.
  template <typename TickOf>
  void run(state::Louse* lice, std::size_t count, const TickOf& tick_of, BatchLists& lists,
           StepCounters& counters) {
    for (std::size_t from = 0; from < count; from += kBlock) {
      const std::size_t size = count - from < kBlock ? count - from : kBlock;
      const std::size_t batches = (size + kCount - 1) / kCount;
      for (std::size_t b = 0; b < batches; ++b) {
        Batch& batch = batches_[b];
        const std::size_t lanes = size - b * kCount;
        for (std::size_t l = 0; l < kCount; ++l) {
          const LouseTick tick = tick_of(from + b * kCount + (l < lanes ? l : 0));
          batch.after[l] = tick.remaining;
          batch.lice[l] = lice + tick.index;
        }
        batch.active = lanes < kCount ? (1u << lanes) - 1u : (1u << (kCount - 1)) * 2u - 1u;
        batch.remaining = L::load(batch.after);
      }
      step_block(batches);
      counters.sub_steps += size;
      counters.samples += kSamples * size;
      for (std::size_t b = 0; b < batches; ++b) {
        const Batch& batch = batches_[b];
        for (unsigned open = batch.active & (batch.special | ~batch.finished); open != 0; open &= open - 1) {
          const auto l = static_cast<std::size_t>(__builtin_ctz(open));
          LouseTick tick = tick_of(from + b * kCount + l);
          if ((batch.special >> l & 1u) != 0) {
            lists.left.push_back(tick);
            --counters.sub_steps;
            counters.samples -= kSamples;
          } else {
            auto& list = tick.pieces + 1 < kMaxPieces ? lists.again : lists.left;  // out of sub-steps
            list.push_back({tick.index, tick.pieces + 1, batch.after[l]});
          }
        }
      }
    }
  }

  void step_block(std::size_t batches) {
    const auto all = [&](auto stage) __attribute__((always_inline)) {
      for (std::size_t b = 0; b < batches; ++b) stage(batches_[b]);
    };
    const auto sample = [this](Batch & batch) __attribute__((always_inline)) {
      batch.s = ground_.sample(batch.place);
    };
    const auto accelerate = [this](Batch & batch, Pair<L> & a) __attribute__((always_inline)) {
      a = acceleration<F>(batch.s, batch.w, batch.drive.force, context_.parameters);
    };
    all([this](Batch & batch) __attribute__((always_inline)) { load(batch); });
    all(sample);
    all([&](Batch & batch) __attribute__((always_inline)) { accelerate(batch, batch.a1); });
    all([this](Batch & batch) __attribute__((always_inline)) { depart(batch); });
    all(sample);
    all([&](Batch & batch) __attribute__((always_inline)) {
      accelerate(batch, batch.a2);
      const L half = L(0.5) * batch.h;
      if constexpr (F::thrust) batch.drive.turn(batch.drive.r2, batch.w, half);
      batch.w = batch.start.velocity + half * batch.a2;
      batch.way = batch.h * core::square_root(squared_length_in_space(batch.s, batch.w));
    });
    all([&](Batch & batch) __attribute__((always_inline)) {
      accelerate(batch, batch.a3);
      const L h = batch.h;
      if constexpr (F::thrust) batch.drive.turn(batch.drive.r3, batch.w, h);
      batch.w = batch.start.velocity + h * batch.a3;
      ground_.locate(nystrom_last(batch.start, batch.a3, h), batch.place);
    });
    all(sample);
    all([&](Batch & batch) __attribute__((always_inline)) {
      accelerate(batch, batch.a4);
      arrive(batch);
    });
    if constexpr (kMayKeepEnergy) {
      if (keeps_energy_) {
        all(sample);
        all([this](Batch & batch) __attribute__((always_inline)) { keep_energy(batch); });
      }
    }
    all([this](Batch & batch) __attribute__((always_inline)) { write_back(batch); });
  }

  [[gnu::always_inline]] inline void load(Batch& batch) {
    LaneFields<L> fields;
    fields.load(batch.lice);
    batch.start.position = {fields.field[0], fields.field[1]};
    batch.start.velocity = {fields.field[2], fields.field[3]};
    batch.drive.heading = {fields.field[4], fields.field[5]};
    batch.thrust = {fields.field[6], fields.field[7]};
    batch.w = batch.start.velocity;
    if constexpr (F::thrust) batch.drive.load(batch.lice, batch.thrust, context_.parameters.thrust_max);
    ground_.locate(batch.start.position, batch.place);
  }

  [[gnu::always_inline]] inline void depart(Batch& batch) {
    using core::any, core::select, core::square_root;
    const auto s = batch.s;
    const Pair<L> x = batch.start.position;
    const Pair<L> v = batch.start.velocity;
    const Pair<L> a1 = batch.a1;
    const L speed2 = squared_length_in_space(s, v);
    const terrain::Rectangle& interior = context_.interior;
    auto special = ~(speed2 > L(kStandstill2)) | ~((x.x > L(interior.x_min)) & (x.x < L(interior.x_max)) &
                                                   (x.y > L(interior.y_min)) & (x.y < L(interior.y_max)));
    L h = batch.remaining;
    const auto asks_for_less = [&]() __attribute__((always_inline)) {
      auto less = context_.rules.too_long(s, speed2, h);
      if constexpr (F::thrust) {
        if (batch.drive.turning != 0) less = less | (batch.drive.turns() & heading_turns_too_far(v, a1, h));
      }
      return less;
    };
    auto too_long = asks_for_less();
    for (auto cut = too_long & (h > L(shortest_)); any(cut); cut = too_long & (h > L(shortest_))) {
      h = select(cut, context_.rules.halved(h), h);
      too_long = asks_for_less();
    }
    special = special | too_long;  // at the cap
    if constexpr (F::singular) {
      L a2 = squared_length_in_space(s, a1) + context_.rules.stiffness2(batch.drive.force.along);
      auto turns = SubStepRules::turns_too_far(a2, speed2, h);
      if constexpr (!F::friction) turns = turns & (batch.drive.force.along < L(0.0));
      turns = turns & ~special;
      if (any(turns)) {
        const L speed = square_root(speed2);
        const L vz = s.zx * v.x + s.zy * v.y;
        const L rate = (dot(v, a1) + vz * (s.zx * a1.x + s.zy * a1.y + curvature_along(s, v))) / speed;
        a2 = select(rate > L(0.0), a2 - rate * rate, a2);
        const auto stops = [&]() __attribute__((always_inline)) { return ~(speed + h * rate > L(0.0)); };
        const auto unresolved = [&]() __attribute__((always_inline)) {
          auto strict = stops();
          if constexpr (F::thrust) {
            strict =
                strict | ~(batch.drive.force.push > L(0.0)) | context_.rules.strays_too_far(a2, speed2, h);
          } else {
            strict = strict | ~strict;
          }
          return SubStepRules::turns_too_far(a2, speed2, h) & strict;
        };
        const auto turning = turns;
        turns = turns & unresolved() & (h > L(shortest_));
        while (any(turns)) {
          h = select(turns, context_.rules.halved(h), h);
          turns = turns & unresolved() & (h > L(shortest_));
        }
        special = special | (turning & (unresolved() | stops()));
      }
    }
    batch.special = special.lanes();
    if constexpr (kMayKeepEnergy) batch.energy = energy(s, v, context_.parameters.gravity);
    batch.h = h;
    const L half = L(0.5) * h;
    if constexpr (F::thrust) batch.drive.turn(batch.drive.r1, v, half);
    batch.w = v + half * a1;
    ground_.locate(nystrom_middle(batch.start, a1, h), batch.place);
  }

  [[gnu::always_inline]] inline typename L::Mask inside(Pair<L> x) const {
    const terrain::Rectangle& interior = context_.interior;
    return (x.x >= L(interior.x_min)) & (x.x <= L(interior.x_max)) & (x.y >= L(interior.y_min)) &
           (x.y <= L(interior.y_max));
  }

  [[gnu::always_inline]] inline void arrive(Batch& batch) {
    batch.end = nystrom_end(batch.start, batch.a1, batch.a2, batch.a3, batch.a4, batch.h);
    if (!kMayKeepEnergy || F::thrust || !keeps_energy_) {
      auto rough = ~nystrom_is_smooth(batch.a1, batch.a2, batch.a3, batch.a4, batch.w, batch.h);
      if constexpr (F::thrust && kMayKeepEnergy) {
        if (keeps_energy_) rough = rough & ~idle(batch);  // keep_energy() sees to those
      }
      if (core::any(rough)) batch.special |= (rough & gains_too_much(batch)).lanes();
    }
    if constexpr (F::thrust) batch.drive.finish(batch.w, batch.h);
    if constexpr (kMayKeepEnergy) {
      batch.special |= (~inside(batch.end.position)).lanes();
      ground_.locate(batch.end.position, batch.place);
    }
  }

  /// For the rare step that asks for heights: the others go without.
  [[nodiscard]] typename G::Sample sample_anew(Pair<L> x) const {
    typename G::Place place;
    ground_.locate(x, place);
    return ground_.sample(place);
  }

  /// Who may have gained energy.
  [[gnu::noinline]] typename L::Mask gains_too_much(const Batch& batch) const {
    const L h = batch.h;
    const Pair<L> x = batch.start.position, last = nystrom_last(batch.start, batch.a3, h);
    const auto s = sample_anew(x);
    L push = L(0.0);
    if constexpr (F::thrust) push = batch.drive.force.push;
    const auto gain = energy_gain(s.z, squared_length_in_space(s, batch.start.velocity),
                                  batch.end.position - x, sample_anew(last), batch.end.position - last,
                                  batch.end.velocity, h, context_.parameters.gravity, push, L(0.0));
    return ~(gain.energy <= context_.rules.bearable_gain(h) * gain.kinetic);
  }

  /// Who has no thrust.
  [[gnu::always_inline]] inline typename L::Mask idle(const Batch& batch) const {
    return ~((batch.drive.force.push > L(0.0)) | (batch.drive.force.along < L(0.0)));
  }

  [[gnu::always_inline]] inline void keep_energy(Batch& batch) {
    const auto kept = with_energy(batch.energy, batch.s, batch.end, batch.h, context_.parameters.gravity);
    if constexpr (F::thrust) {  // who has a thrust does not
      const auto is_idle = idle(batch);
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

  [[gnu::always_inline]] inline void write_back(Batch& batch) {
    using core::select, core::square_root;
    const L h = batch.h;
    const Pair<L> y = batch.end.position;
    const Pair<L> w = batch.end.velocity;
    const L way2 = dot(w, w);
    const auto finished = ~(h != batch.remaining);
    batch.special |= (~(inside(y) & (way2 > L(kStandstill2)))).lanes();
    batch.finished = finished.lanes();
    const unsigned done = batch.active & ~batch.special;

    const L inverse = L(1.0) / square_root(way2);
    LaneFields<L> fields;
    fields.field[0] = y.x;
    fields.field[1] = y.y;
    fields.field[2] = w.x;
    fields.field[3] = w.y;
    fields.field[4] = select(finished, inverse * w.x, batch.drive.heading.x);
    fields.field[5] = select(finished, inverse * w.y, batch.drive.heading.y);
    if constexpr (F::thrust) {
      if (batch.drive.turning != 0) {
        const auto turns = batch.drive.turns();
        fields.field[4] = select(turns, batch.drive.force.direction.x, fields.field[4]);
        fields.field[5] = select(turns, batch.drive.force.direction.y, fields.field[5]);
      }
    }
    fields.field[6] = batch.thrust.x;
    fields.field[7] = batch.thrust.y;
    fields.store(batch.lice, done);
    alignas(64) double way[kCount];
    batch.way.store(way);
    (batch.remaining - h).store(batch.after);
    for (std::size_t l = 0; l < kCount; ++l) {
      if ((done >> l & 1u) != 0) batch.lice[l]->distance += way[l];
    }
  }

  const BatchContext& context_;
  G ground_;
  double shortest_;
  bool keeps_energy_;
  Batch batches_[kBatches];
};

}  // namespace woodlouse::physics
