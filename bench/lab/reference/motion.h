// The lab's own answer to where a louse is after a time on a map as it is played: drag, friction, thrusts
// along a vector and along a heading that turns, brakes, walls, seams, flight, stops, a centre's pull. It
// shares neither equations nor integrator nor events with the step: forces.h, dop853.h, and here the moments,
// each located to the last digits of a long double by repeating the step up to it, so that no step straddles
// one:
//   a line of knots, a wall, a seam; a wall that lets go of a louse which leans on it; the ground that does
//   (take-off on a unilateral map), and the landing on the parabola's own polynomial; the rim of a central
//   core; a stop, towards which steps shrink with the speed.
// Open edges it has not: no map is roamed with them.
#pragma once

#include <cstddef>

#include "bench/lab/reference/forces.h"
#include "shared/map/map_definition.h"
#include "shared/state/louse.h"

namespace woodlouse::lab::reference {

/// What was met, and what it took.
struct Record {
  std::size_t steps = 0, refused = 0;
  std::size_t lines = 0, walls = 0, seams = 0, take_offs = 0, landings = 0, stops = 0, core_rims = 0;
};

/// How the length of steps is chosen.
struct Care {
  Real tolerance = 1e-17L;  ///< of a step's estimated error, in m, m/s and of the heading's 1
  Real longest = 0.05L;     ///< [s]
  bool adapts = true;       ///< false: every step is `longest`, or up to an event; for the order itself
};

/// One louse on one map. One thread at a time.
class Motion {
 public:
  /// REQUIRES a ground that Ground::knows, and no open edges; both must outlive this. The louse's own thrust
  /// says whether its heading is a state of its own.
  Motion(const terrain::Terrain& terrain, const state::Parameters& parameters, const state::Louse& start,
         const Care& care = {});

  /// Moves it on with this thrust acting all the while.
  void advance(Real seconds, const state::Thrust& thrust);

  [[nodiscard]] Pair position() const { return {at_[kX], at_[kY]}; }
  [[nodiscard]] Pair velocity() const { return {at_[kVx], at_[kVy]}; }
  [[nodiscard]] bool flies() const { return flies_; }
  [[nodiscard]] bool rests() const { return rests_; }
  /// Whether events came without end: where it is then says nothing.
  [[nodiscard]] bool gave_up() const { return gave_up_; }
  [[nodiscard]] Real height() const { return flies_ ? z_ : here(at_).z; }
  [[nodiscard]] const Record& record() const { return record_; }

 private:
  enum : std::size_t { kX, kY, kVx, kVy, kHx, kHy, kSize };
  using State = Values<kSize>;
  enum class Event { kNone, kLineX, kLineY, kLeavesWallX, kLeavesWallY, kTakesOff, kCore, kTurnsBack };

  [[nodiscard]] Place here(const State& s) const { return ground_.at(cell_, s[kX], s[kY]); }
  [[nodiscard]] Acting acting_at(const State& s) const;
  /// What walls push with, inwards, that the louse leans on; below 0 where one should let go.
  [[nodiscard]] Pair leaning(const State& s) const;
  [[nodiscard]] State slope(const State& s) const;
  [[nodiscard]] State stepped(Real h) const;

  [[nodiscard]] Thrust thrust_at(const State& s) const;
  void lean();
  void slide(Real& remaining);
  void fly(Real& remaining);
  bool stand(Real& remaining);
  [[nodiscard]] bool resists() const;
  Real chosen_step(Real remaining) const;
  Real take_step(Real h, State& end);
  /// The first event in a step of h, and its moment; end becomes the state there.
  Event first_event(Real& h, State& end) const;
  template <typename Value>
  [[nodiscard]] Real located(Real h, const Value& value, State& end) const;
  void meet(Event event);
  void meet_line(bool along_x);
  void bounce();
  void land();
  void look_along_velocity();

  Ground ground_;
  state::Parameters parameters_;
  Care care_;
  State at_{};
  Cell cell_;
  Thrust thrust_;
  Touched leans_;  ///< on which walls, as of this step
  bool flies_ = false, rests_ = false, gave_up_ = false;
  Real z_ = 0, climb_ = 0;  ///< in flight
  Real next_step_ = 1e-4L;
  Record record_;
};

}  // namespace woodlouse::lab::reference
