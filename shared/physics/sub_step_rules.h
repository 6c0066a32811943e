// When a step is too long, as functions of the state alone. A sub-step h is halved while
//     h |v| |H|_F > kBend   or   h sqrt(g |H|_F) > kSwing   or   h sqrt(k / r^3) > kOrbit   or   h d > kDecay
//     or h |v| > one cell (where energy is kept: half a cell; two knot lines in a step err beyond what one
//     projection mends),
// and, where a force turns with v (friction, a drive along the heading), while h |a| > kTurn |v|: near a stop
// the direction of v swings. What holds against v, friction and brake of b m/s^2 in all, draws that direction
// to the pull's at a rate of b / |v|, though |a| may be small: that counts as if |a|^2 were greater by (b
// kTurn / 2)^2, which keeps h b below 2 |v|. Slope is no limit; curvature times speed, and gravity times
// curvature, are.
//
// That last rule is for where a louse comes to rest, which must not hang on the rate. While a push acts, and
// does not end in a stop, what counts is how far astray the turn leads in metres: about b h^2 (h |a| /
// |v|)^4, which may be kAstray; a thrust that changes with every tick then costs a few sub-steps and not a
// dozen.
//
// A map with a tolerance has its steps halved besides until three times what they err (astray(), nystrom.h)
// is at most tolerance times h.
//
// The comparisons are between squares and higher powers: no roots. T is double, or several at once.
#pragma once

#include "shared/physics/surface_motion.h"
#include "shared/state/parameters.h"

namespace woodlouse::physics {

/// What is left of an orbit's phase to a sub-step, h sqrt(pull), and how many sub-steps a tick has.
inline constexpr double kOrbit = 0.05;
inline constexpr double kMaxSubSteps = 256.0;

/// A sub-step on the ground.
struct SubStep {
  double h;      ///< [s]
  double speed;  ///< |v|3 at its start [m/s]
  bool capped;   ///< it wanted to be shorter
};

class SubStepRules {
 public:
  /// way: the longest that a sub-step may lead, the side of the surface's smallest cell or a part of it [m].
  SubStepRules(const state::Parameters& p, double way, double tick)
      : shortest_(tick / kMaxSubSteps),
        longest_(p.drag > 0.0 && kDecay / p.drag < tick ? kDecay / p.drag : tick),
        gain_rate_(kMaxGain / tick),
        inverse_way2_(1.0 / (way * way)),
        swing_factor_(p.gravity * p.gravity / (kSwing * kSwing * kSwing * kSwing)),
        grip_(p.friction * p.gravity),
        astray_factor_(grip_ / kAstray),
        tolerance_(p.tolerance) {}

  /// No sub-step is halved further [s].
  [[nodiscard, gnu::always_inline]] inline double shortest() const { return shortest_; }

  /// Half of h, or the shortest: so that a tick has no more than kMaxSubSteps of them.
  template <typename T>
  [[gnu::always_inline, nodiscard]] inline T halved(T h) const {
    const T half = T(0.5) * h;
    return core::select(half > T(shortest_), half, T(shortest_));
  }

  /// Whether curvature, speed, drag or the cells ask for less than h. speed2: |v|3^2.
  template <typename Sample, typename T>
  [[gnu::always_inline, nodiscard]] inline auto too_long(const Sample& s, T speed2, T h) const {
    if constexpr (terrain::Curved<Sample>) {
      const T h2 = h * h;
      const T hessian2 = s.zxx * s.zxx + T(2.0) * s.zxy * s.zxy + s.zyy * s.zyy;
      const T way2 = h2 * speed2;
      return (way2 * hessian2 > T(kBend * kBend)) | (h2 * h2 * hessian2 * T(swing_factor_) > T(1.0)) |
             (way2 * T(inverse_way2_) > T(1.0)) | (h > T(longest_));
    } else {
      return h > T(longest_);  // flat ground has no cells either
    }
  }

  /// What a step over h may gain of energy, of the kinetic energies of both its ends: in a tick kMaxGain. Of
  /// a method that shows its own energy, whose gains are lost again, a step may as much, but a tick not many
  /// times that.
  template <bool kKeepsEnergy = true, typename T>
  [[gnu::always_inline, nodiscard]] inline T bearable_gain(T h) const {
    const T share = T(gain_rate_) * h;
    if constexpr (kKeepsEnergy) return share;
    const T shown = T(kShownGains) * share;
    return core::select(shown < T(kMaxGain), shown, T(kMaxGain));
  }

  /// Whether central gravity asks for less than h; pull: k / r^3 [1/s^2].
  template <typename T>
  [[gnu::always_inline, nodiscard]] static inline auto swings_too_far(T pull, T h) {
    return h * h * pull > T(kOrbit * kOrbit);
  }

  /// Whether v may turn too far within h; only where some force turns with v. acceleration2: with
  /// stiffness2() in it.
  template <typename T>
  [[gnu::always_inline, nodiscard]] static inline auto turns_too_far(T acceleration2, T speed2, T h) {
    return h * h * acceleration2 > T(kTurn * kTurn) * speed2;
  }

  /// Whether the turn that h may bring leads too far astray, while a push acts.
  template <typename T>
  [[gnu::always_inline, nodiscard]] inline auto strays_too_far(T acceleration2, T speed2, T h) const {
    const T h2 = h * h;
    const T turn2 = h2 * acceleration2;
    return h2 * T(astray_factor_) * (turn2 * turn2) > speed2 * speed2;
  }

  /// What friction and a drive along v add to |a|^2 in turns_too_far. along: of the drive [m/s^2]; negative
  /// brakes.
  template <typename T>
  [[gnu::always_inline, nodiscard]] inline T stiffness2(T along) const {
    return squared(T(0.5 * kTurn) * (T(grip_) + core::select(along < T(0.0), -along, T(0.0))));
  }

  /// Whether the map bears only so much of error.
  [[nodiscard, gnu::always_inline]] inline bool has_tolerance() const { return tolerance_ > 0.0; }

  /// Whether the map bears what a step over h errs, or none shorter may be tried. error: astray() [m].
  template <typename T>
  [[gnu::always_inline, nodiscard]] inline auto bears(T error, T h) const {
    return (T(kSafety) * error <= T(tolerance_) * h) | (h <= T(kShortestErring * shortest_));
  }

  /// How long the next step of a tick may be, once one was refused for its error: halves or doubles of h, of
  /// which order 4 lets expect that they are borne; at most `tick` [s].
  [[nodiscard]] double borne_length(double error, double h, double tick) const {
    constexpr double kFifth = 32.0;  // by which a step's error shrinks with half of it
    if (bears(error, h)) {
      while (2.0 * h <= tick && bears(kDoubt * kFifth * error, 2.0 * h)) {
        h *= 2.0;
        error *= kFifth;
      }
    } else {
      do {
        h *= 0.5;
        error *= 1.0 / kFifth;
      } while (!bears(error, h));
    }
    return h;
  }

 private:
  /// What astray() may leave out, and how much of it a longer step is trusted with.
  static constexpr double kSafety = 3.0;
  static constexpr double kDoubt = 2.0;
  /// Steps are shortened for their error to twice the shortest: so those that were refused find room too
  /// among the sub-steps of a tick.
  static constexpr double kShortestErring = 2.0;
  static constexpr double kBend = 0.15;
  static constexpr double kSwing = 0.20;
  static constexpr double kDecay = 0.25;
  static constexpr double kTurn = 0.10;
  static constexpr double kMaxGain = 2e-4;
  static constexpr double kShownGains = 25.0;
  static constexpr double kAstray = 3e-7;  // [m]

  double shortest_;
  double longest_;
  double gain_rate_;
  double inverse_way2_;
  double swing_factor_;
  double grip_;  ///< what friction can hold on the level [m/s^2]
  double astray_factor_;
  double tolerance_;  ///< [m/s of play]
};

}  // namespace woodlouse::physics
