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
//     where the contact is unilateral, a sample at the end: who loses it there is left
//     write back what is done
// Who has not used up the tick goes through again, with others of that kind; at last those who slide along a
// wall, whose accelerations have its force besides. Who flies does so before all that (flight.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "shared/physics/batch.h"
#include "shared/physics/integrators.h"
#include "shared/physics/lanes/batch.h"
#include "shared/physics/lanes/energy.h"
#include "shared/physics/lanes/fields.h"
#include "shared/physics/lanes/flight.h"
#include "shared/physics/lanes/grounds.h"
#include "shared/physics/lanes/sub_step.h"
#include "shared/physics/lanes/walls.h"
#include "shared/physics/nystrom.h"

namespace woodlouse::physics {

/// L: the lanes; F: the Forces the map has; G: its ground (grounds.h).
template <typename L, typename F, typename G>
class LaneStepper {
 public:
  explicit LaneStepper(const BatchContext& context)
      : context_(context),
        ground_(context),
        keeps_energy_(kMayKeepEnergy && conserves_energy(context.parameters)),
        has_walls_(context.parameters.edges == state::Edges::kWalls),
        unilateral_(kCurved && context.parameters.contact == state::SurfaceContact::kUnilateral),
        samples_(kSamples + (context.rules.has_tolerance() ? kLobattoSamples : 0)) {}

  /// See BatchStep.
  void advance(state::Louse* lice, std::span<const std::uint32_t> moving, BatchLists& lists,
               StepCounters& counters) {
    lists.left.clear();
    lists.again.clear();
    lists.at_wall.clear();
    if (unilateral_) {
      fly(lice, moving, lists, counters);
    } else {
      const auto whole = [&](std::size_t i) { return LouseTick{moving[i], 0, context_.tick}; };
      run(lice, moving.size(), whole, lists, counters);
    }
    go_on(lice, false, lists, counters);
    if (lists.at_wall.empty()) return;
    lists.again.swap(lists.at_wall);
    go_on(lice, true, lists, counters);
  }

  /// Those of lists.again, until they are through the tick or left; see GoOn.
  void go_on(state::Louse* lice, bool at_wall, BatchLists& lists, StepCounters& counters) {
    at_wall_ = at_wall;
    while (!lists.again.empty()) {
      if (kCount > kFewLice && lists.again.size() <= kFewLice && context_.few != nullptr)
        return context_.few(context_, lice, at_wall, lists, counters);
      lists.now.swap(lists.again);
      lists.again.clear();
      run(
          lice, lists.now.size(), [&](std::size_t i) { return lists.now[i]; }, lists, counters);
    }
  }

 private:
  using Batch = LaneBatch<L, F, G>;

  static constexpr std::size_t kCount = L::kCount;
  static constexpr std::size_t kBlock = 32;
  static constexpr std::size_t kBatches = kBlock / kCount;
  static constexpr auto kMaxPieces = static_cast<std::uint32_t>(kMaxSubSteps);
  static constexpr std::size_t kSamples = Nystrom4::kSamples + 1;  // with the start's
  static constexpr bool kCurved = terrain::Curved<typename G::Sample>;
  static constexpr bool kMayKeepEnergy = Batch::kMayKeepEnergy;

  /// Who flies does so in lanes of his own; the others are then in lists.again.
  void fly(state::Louse* lice, std::span<const std::uint32_t> moving, BatchLists& lists,
           StepCounters& counters) {
    lists.in_air.clear();
    for (const std::uint32_t index : moving) {
      auto& list = lice[index].phase == state::Phase::kFlying ? lists.in_air : lists.again;
      list.push_back({index, 0, context_.tick});
    }
    if constexpr (kCurved) LaneFlyer<L, G, F::thrust>(context_, ground_).advance(lice, lists, counters);
  }

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
      counters.samples += samples_ * size;
      for (std::size_t b = 0; b < batches; ++b) {
        const Batch& batch = batches_[b];
        for (unsigned open = batch.active & (batch.special | ~batch.finished); open != 0; open &= open - 1) {
          const auto l = static_cast<std::size_t>(__builtin_ctz(open));
          LouseTick tick = tick_of(from + b * kCount + l);
          if ((batch.special >> l & 1u) != 0) {
            const bool leans = has_walls_ && !at_wall_ && (batch.at_rim >> l & 1u) != 0;
            (leans ? lists.at_wall : lists.left).push_back(tick);
            --counters.sub_steps;
            counters.samples -= samples_;
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
      if (at_wall_) {
        lean(batch, a);
      } else {
        a = acceleration<F>(batch.s, batch.w, batch.drive.force, context_.parameters);
      }
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
      batch.move_to(ground_, context_.parameters, nystrom_last(batch.start, batch.a3, h));
    });
    all(sample);
    all([&](Batch & batch) __attribute__((always_inline)) {
      accelerate(batch, batch.a4);
      arrive(batch);
    });
    if (context_.rules.has_tolerance()) {
      for (std::size_t b = 0; b < batches; ++b) check_error(batches_[b]);
    }
    if constexpr (kMayKeepEnergy) {
      if (brings_to_energy()) {
        all(sample);
        all([this](Batch & batch)
                __attribute__((always_inline)) { keep_energy(batch, context_.parameters); });
      }
    }
    if (kCurved && unilateral_) {
      all([this](Batch & batch) __attribute__((always_inline)) {
        batch.move_to(ground_, context_.parameters, batch.end.position);
      });
      all(sample);
      all([this](Batch & batch) __attribute__((always_inline)) { hold_down(batch); });
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
    if (at_wall_) {
      batch.sliding =
          slides_along_wall(context_.interior, batch.start.position, batch.w, batch.walls).lanes();
    }
    batch.move_to(ground_, context_.parameters, batch.start.position);
  }

  /// Whether the ends of who has no thrust are brought to the energy of the start; at walls they are not.
  [[nodiscard, gnu::always_inline]] inline bool brings_to_energy() const {
    return keeps_energy_ && !at_wall_;
  }

  /// The acceleration of who slides along a wall.
  [[gnu::noinline]] void lean(Batch& batch, Pair<L>& a) const {
    a = accelerate_at_wall<F>(batch.s, batch.w, batch.drive.force, batch.walls, context_.parameters);
  }

  [[gnu::always_inline]] inline void depart(Batch& batch) {
    const Pair<L> x = batch.start.position;
    const Pair<L> v = batch.start.velocity;
    const L speed2 = squared_length_in_space(batch.s, v);
    const terrain::Rectangle& interior = context_.interior;
    const auto free = (x.x > L(interior.x_min)) & (x.x < L(interior.x_max)) & (x.y > L(interior.y_min)) &
                      (x.y < L(interior.y_max));
    batch.at_rim = (~free).lanes();
    L pull(0.0);
    if constexpr (F::central) pull = central_pull(x, context_.parameters);
    batch.special = (~(speed2 > L(kStandstill2))).lanes() | (at_wall_ ? ~batch.sliding : batch.at_rim);
    const auto [h, left] =
        choose_sub_step<F>(context_.rules, batch.start, batch.s, speed2, batch.a1, batch.drive, pull,
                           batch.remaining, L::Mask::of(~batch.special));
    batch.special |= left.lanes();
    if constexpr (kMayKeepEnergy) batch.energy = energy(batch.s, v, context_.parameters.gravity);
    batch.h = h;
    const L half = L(0.5) * h;
    if constexpr (F::thrust) batch.drive.turn(batch.drive.r1, v, half);
    batch.w = v + half * batch.a1;
    batch.move_to(ground_, context_.parameters, nystrom_middle(batch.start, batch.a1, h));
  }

  [[gnu::always_inline]] inline typename L::Mask inside(Pair<L> x) const {
    const terrain::Rectangle& interior = context_.interior;
    return (x.x >= L(interior.x_min)) & (x.x <= L(interior.x_max)) & (x.y >= L(interior.y_min)) &
           (x.y <= L(interior.y_max));
  }

  [[gnu::always_inline]] inline void arrive(Batch& batch) {
    batch.end = nystrom_end(batch.start, batch.a1, batch.a2, batch.a3, batch.a4, batch.h);
    if (!kMayKeepEnergy || F::thrust || !brings_to_energy()) {
      auto rough = ~nystrom_is_smooth(batch.a1, batch.a2, batch.a3, batch.a4, batch.w, batch.h);
      if constexpr (F::thrust && kMayKeepEnergy) {
        if (brings_to_energy()) rough = rough & ~batch.idle();  // keep_energy() sees to those
      }
      if (core::any(rough)) batch.special |= (rough & gains_too_much(batch, ground_, context_)).lanes();
    }
    if constexpr (F::thrust) batch.drive.finish(batch.w, batch.h);
    if constexpr (kMayKeepEnergy) {
      batch.special |= (~inside(batch.end.position)).lanes();
      batch.move_to(ground_, context_.parameters, batch.end.position);
    }
  }

  /// Whose step errs more than the map bears, and who turns along, whose heading on the way is not known
  /// here.
  [[gnu::noinline]] void check_error(Batch& batch) const {
    const auto accelerate = [&](double, const BasicMotion<L>& at) __attribute__((always_inline)) {
      batch.move_to(ground_, context_.parameters, at.position);
      const auto s = ground_.sample(batch.place);
      return at_wall_
                 ? accelerate_at_wall<F>(s, at.velocity, batch.drive.force, batch.walls, context_.parameters)
                 : acceleration<F>(s, at.velocity, batch.drive.force, context_.parameters);
    };
    const L error = astray(batch.start, batch.a1, batch.end, batch.h, accelerate);
    batch.special |= (~context_.rules.bears(error, batch.h)).lanes();
    if constexpr (F::thrust) batch.special |= batch.drive.turning;
    batch.move_to(ground_, context_.parameters, batch.end.position);
  }

  /// Whom the ground no longer carries at the step's end.
  [[gnu::always_inline]] inline void hold_down(Batch& batch) const {
    const LaneWalls<L>* walls = at_wall_ ? &batch.walls : nullptr;
    const L load = normal_load<F>(batch.s, batch.end.velocity, batch.drive.force, walls, context_.parameters);
    batch.special |= (load < L(0.0)).lanes();
    if constexpr (F::thrust) {
      if (at_wall_) batch.special |= batch.drive.turning;  // a wall's load is of the heading at the start
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
  bool keeps_energy_;
  bool has_walls_;
  bool unilateral_;
  std::size_t samples_;   ///< of a sub-step
  bool at_wall_ = false;  ///< those that slide along a wall are stepped
  Batch batches_[kBatches];
};

}  // namespace woodlouse::physics
