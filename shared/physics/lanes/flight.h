// Lanes of lice in the air (physics/flight.h): pieces of their parabolas. Landings, walls, open edges and
// seams are the scalar step's. Under the rules of kernel.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "shared/physics/batch.h"
#include "shared/physics/heading.h"
#include "shared/physics/lanes/fields.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// L: the lanes; G: the ground (grounds.h); kThrust: whether the map has thrusts.
template <typename L, typename G, bool kThrust>
class LaneFlyer {
 public:
  LaneFlyer(const BatchContext& context, const G& ground)
      : context_(context),
        ground_(ground),
        wraps_(context.parameters.edges == state::Edges::kWrap),
        longest_(context.cell < std::numeric_limits<double>::infinity() ? context.tick
                                                                        : context.tick / 32.0) {}

  /// Those of lists.in_air, until they are through the tick or left.
  void advance(state::Louse* lice, BatchLists& lists, StepCounters& counters) const {
    std::size_t lanes = 0;
    for (std::size_t from = 0; from < lists.in_air.size(); from += lanes) {  // which grows on the way
      Piece piece;
      lanes = lists.in_air.size() - from < kCount ? lists.in_air.size() - from : kCount;
      for (std::size_t l = 0; l < kCount; ++l) {
        const LouseTick& tick = lists.in_air[from + (l < lanes ? l : 0)];
        piece.lice[l] = lice + tick.index;
        piece.remaining[l] = tick.remaining;
      }
      const unsigned active = (1u << (lanes - 1)) * 2u - 1u;
      const unsigned flown = fly(piece, active);
      for (unsigned open = active; open != 0; open &= open - 1) {
        const auto l = static_cast<std::size_t>(__builtin_ctz(open));
        LouseTick tick = lists.in_air[from + l];
        if ((flown >> l & 1u) == 0) {
          lists.left.push_back(tick);
          continue;
        }
        ++counters.sub_steps;
        if (!(piece.remaining[l] > 0.0)) continue;
        tick = {tick.index, tick.pieces + 1, piece.remaining[l]};
        const bool may_go_on = tick.pieces < static_cast<std::uint32_t>(kMaxSubSteps);
        (may_go_on ? lists.in_air : lists.left).push_back(tick);
      }
    }
  }

 private:
  static constexpr std::size_t kCount = L::kCount;

  struct Piece {
    state::Louse* lice[kCount];
    alignas(64) double remaining[kCount];  ///< before the piece, then after it
  };

  /// As Flyer::fly() and fly_on(); the lanes that nothing happened to.
  [[nodiscard]] unsigned fly(Piece& piece, unsigned active) const {
    using core::select, core::square_root;
    const L g(context_.parameters.gravity);
    LaneFields<L> fields;
    fields.load(piece.lice);
    alignas(64) double heights[kCount], climbs[kCount], ways[kCount];
    for (std::size_t l = 0; l < kCount; ++l) {
      heights[l] = piece.lice[l]->flight_z;
      climbs[l] = piece.lice[l]->flight_vz;
    }
    const L height = L::load(heights), climb = L::load(climbs), remaining = L::load(piece.remaining);
    const Pair<L> x{fields.field[0], fields.field[1]}, v{fields.field[2], fields.field[3]};

    L time = select(remaining < L(longest_), remaining, L(longest_));
    const L way2 = dot(v, v);
    const L speed = square_root(way2);
    const L quarter(0.25 * context_.cell);
    time = select(speed * time > quarter, quarter / speed, time);
    const Pair<L> end = x + time * v;
    const L end_height = height + time * climb - L(0.5) * g * time * time;
    const L end_climb = climb - g * time;
    typename G::Place place;
    ground_.locate(end, place);
    const auto lands = end_height - ground_.sample(place).z <= L(0.0);
    const unsigned flown = active & (~lands & meets_nothing(x, v, time, end)).lanes();

    time = select(time < remaining, time, remaining);
    const L rest = remaining - time;
    const auto speed_after = [&](L t) __attribute__((always_inline)) {
      const L c = climb - g * t;
      return square_root(way2 + c * c);
    };
    const L way =
        time / L(6.0) * (speed_after(L(0.0)) + L(4.0) * speed_after(L(0.5) * time) + speed_after(time));
    // A heading is written at the tick's end, but where a thrust acts along it.
    unsigned along = 0;
    for (std::size_t l = 0; kThrust && l < kCount; ++l)
      along |= (drives_along_heading(*piece.lice[l]) ? 1u : 0u) << l;
    const auto turns = (~(rest > L(0.0)) | L::Mask::of(along)) & (way2 > L(kStandstill2));
    const Pair<L> heading = unit(v);
    fields.field[0] = end.x;
    fields.field[1] = end.y;
    fields.field[4] = select(turns, heading.x, fields.field[4]);
    fields.field[5] = select(turns, heading.y, fields.field[5]);
    fields.store(piece.lice, flown);
    rest.store(piece.remaining);
    end_height.store(heights);
    end_climb.store(climbs);
    way.store(ways);
    for (unsigned open = flown; open != 0; open &= open - 1) {
      const auto l = static_cast<std::size_t>(__builtin_ctz(open));
      piece.lice[l]->flight_z = heights[l];
      piece.lice[l]->flight_vz = climbs[l];
      piece.lice[l]->distance += ways[l];
    }
    return flown;
  }

  /// No wall and no open edge on the way, no seam at its end.
  [[nodiscard]] typename L::Mask meets_nothing(Pair<L> x, Pair<L> v, L time, Pair<L> end) const {
    using core::select;
    const terrain::Rectangle& box = context_.interior;
    if (wraps_) {
      return (end.x >= L(box.x_min)) & (end.x <= L(box.x_max)) & (end.y >= L(box.y_min)) &
             (end.y <= L(box.y_max));
    }
    const auto is_before = [&](L at, L speed, double low, double high) __attribute__((always_inline)) {
      const L to_wall = (select(speed > L(0.0), L(high), L(low)) - at) / speed;
      return ~(speed != L(0.0)) | ~(to_wall <= time);
    };
    return is_before(x.x, v.x, box.x_min, box.x_max) & is_before(x.y, v.y, box.y_min, box.y_max);
  }

  /// As drive_of() tells.
  static bool drives_along_heading(const state::Louse& louse) {
    return louse.thrust_kind == state::ThrustKind::kAlongHeading && louse.thrust.x > 0.0;
  }

  const BatchContext& context_;
  const G& ground_;
  bool wraps_;
  double longest_;
};

}  // namespace woodlouse::physics
