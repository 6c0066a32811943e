// What acts on a louse at a place: the surface's sample there, the equations E with the map's forces F, and
// the walls that it leans on. An integrator (integrators.h) asks for it through a Field, one for each
// sub-step.
#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

#include "shared/physics/bounded_energy.h"
#include "shared/physics/central_gravity.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/rim.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/surface_motion.h"
#include "shared/physics/walls.h"
#include "shared/state/parameters.h"
#include "shared/terrain/surface.h"

namespace woodlouse::physics {

/// A sample that knows the central pull there.
template <typename Sample>
struct PulledSample : Sample {
  core::Vec2 pull;
};

/// Refers to `surface` and `parameters`.
template <terrain::Surface S, typename F, typename E>
class Ground {
 public:
  using Sample = decltype(std::declval<const S&>().sample(0.0, 0.0));
  using Site = std::conditional_t<F::central, PulledSample<Sample>, Sample>;
  static constexpr bool kTurns = E::kExact && F::thrust;  ///< a drive may act along a heading that turns

  /// What a sub-step knows of its start.
  struct Start {
    Motion at;
    Site sample;
    core::Vec2 acceleration;
    double speed2 = 0.0;  ///< |v|3^2
    Contact contact;      ///< the walls it may lean on: no velocity along their normals
  };

  Ground(const S& surface, const state::Parameters& parameters) : surface_(surface), parameters_(parameters) {
    assert(!F::central || parameters.central_gravity <= 0.0 || parameters.core_radius > 0.0);
  }

  [[nodiscard]] const S& surface() const { return surface_; }

  [[nodiscard, gnu::always_inline]] inline Site site_of(const Sample& s, core::Vec2 x) const {
    if constexpr (F::central) {
      return {s, -central_pull(x, parameters_) * x};
    } else {
      return s;
    }
  }

  [[nodiscard, gnu::always_inline]] inline Site site(core::Vec2 x) const {
    return site_of(surface_.sample(x.x, x.y), x);
  }

  [[nodiscard, gnu::always_inline]] inline core::Vec2 accelerate(const Site& s, core::Vec2 v,
                                                                 const Drive& drive, Contact contact) const {
    if (contact.any()) return accelerate_at_wall(s, v, drive, contact);
    return E::template acceleration<F>(s, v, drive_at(s, drive), parameters_);
  }

  /// N w, the normal force that the ground carries [m/s^2]: below 0, a unilateral contact ends.
  [[nodiscard]] double load(const Site& s, core::Vec2 v, const Drive& drive,
                            Contact contact) const requires E::kExact {
    double result = parameters_.gravity + curvature_along(s, v);
    if constexpr (F::central) result += s.zx * s.pull.x + s.zy * s.pull.y;
    return contact.any() ? result + wall_load(s, contact, frictionless(s, v, drive)) : result;
  }

  /// What a louse at rest there would have of energy [m^2/s^2].
  [[nodiscard]] double potential_at(core::Vec2 x, const Site& s) const {
    return potential<F::central>(x, s.z, parameters_);
  }

  /// What a step over h to `end` has gained with a push; as a sample tells that was taken at `place`, at its
  /// end or near it.
  [[nodiscard, gnu::always_inline]] inline Gain gain(const Start& start, const Site& s, core::Vec2 place,
                                                     const Motion& end, double h, double push) const {
    const core::Vec2 from = start.at.position;
    double fallen = 0.0;
    if (F::central && parameters_.central_gravity > 0.0)
      fallen = central_potential(from, parameters_) - central_potential(end.position, parameters_);
    return energy_gain(start.sample.z, start.speed2, end.position - from, s, end.position - place,
                       end.velocity, h, parameters_.gravity, push, fallen);
  }

  /// v after the implicit half kick v' = v + k a(s, v').
  [[nodiscard]] core::Vec2 kick(const Site& s, core::Vec2 v, double k, const Drive& drive,
                                Contact contact) const requires E::kExact {
    if (!contact.any()) return implicit_kick<F>(s, v, k, drive_at(s, drive), parameters_, 0.0);
    const double carried = wall_load(s, contact, frictionless(s, v, drive));
    return bounced(s, contact, implicit_kick<F>(s, v, k, drive_at(s, drive), parameters_, carried), 0.0);
  }

  /// Whether the rules ask for a sub-step shorter than h.
  [[nodiscard]] bool is_too_long(const SubStepRules& rules, const Start& start, const Drive& drive,
                                 double h) const {
    if constexpr (F::central) {
      if (SubStepRules::swings_too_far(central_pull(start.at.position, parameters_), h)) return true;
    }
    if (kTurns && drive.turns && heading_turns_too_far(start.at.velocity, start.acceleration, h)) return true;
    return rules.too_long(start.sample, start.speed2, h);
  }

  /// What pulls at v = 0, and what friction can hold there.
  [[nodiscard]] RestingBalance balance(const Start& start, const Drive& drive) const {
    const Contact contact = start.contact;
    RestingBalance b = resting_balance<F>(
        start.sample, drive_at(start.sample, drive), parameters_,
        [&](core::Vec2 pull) { return contact.any() ? wall_load(start.sample, contact, pull) : 0.0; });
    if (contact.any()) b.pull = supported(start.sample, contact, b.pull);
    return b;
  }

  /// Off the walls that it runs into, if any; a heading that turns is thrown back as the velocity is.
  bool bounce(Start& start, Drive& drive, double restitution) const {
    core::Vec2& v = start.at.velocity;
    if (!outward(start.contact.x, v.x) && !outward(start.contact.y, v.y)) return false;
    v = bounced(start.sample, start.contact, v, restitution);
    if (!drive.turns) return true;
    const core::Vec2 thrown = bounced(start.sample, start.contact, drive.direction, restitution);
    if (dot(thrown, thrown) > kStandstill2) point(drive, unit(thrown));
    return true;
  }

  /// Of the walls that are touched, leaves those in `contact` that the louse leans on: no velocity along
  /// their normals. One that it leaves so slowly that it is back within rounding of the wall, it has not
  /// left: without that, a louse in a corner would bounce off two walls without end.
  void lean_on(Start& start, const Drive& drive, const Rim& rim) const {
    const Contact touched = start.contact;
    core::Vec2& v = start.at.velocity;
    start.contact = {v.x != 0.0 ? 0 : touched.x, v.y != 0.0 ? 0 : touched.y};
    const Contact left{touched.x - start.contact.x, touched.y - start.contact.y};
    if (!left.any()) return;
    const core::Vec2 a = accelerate(start.sample, v, drive, start.contact);
    const auto falls_back = [&](int side, double leaving, double pull) {
      return outward(side, pull) && leaving * leaving <= 4.0 * rim.tolerance() * std::fabs(pull);
    };
    const bool x = falls_back(left.x, v.x, a.x);
    const bool y = falls_back(left.y, v.y, a.y);
    if (!x && !y) return;
    const Contact leans{x ? touched.x : start.contact.x, y ? touched.y : start.contact.y};
    if (leans.x != 0 && leans.y != 0) {
      v = {0.0, 0.0};
    } else {
      v = x ? react_x(start.sample, v, 1.0) : react_y(start.sample, v, 1.0);
    }
    start.contact = leans;
  }

  /// What a sub-step from there begins with: the surface's sample, the walls it leans on, a1. Who runs into a
  /// wall is thrown back first, and `bounces` set. kRules: who is slower than can be told stands still.
  template <bool kRules>
  Start depart(const Motion& at, Drive& drive, const Rim& rim, double restitution, bool& bounces) const {
    Start start;
    start.at = at;
    start.sample = site(at.position);
    start.contact = rim.touching(at.position);
    if (start.contact.any()) {
      bounces = bounce(start, drive, restitution);
      lean_on(start, drive, rim);
    }
    start.speed2 = squared_length_in_space(start.sample, start.at.velocity);
    if (kRules && !(start.speed2 > kStandstill2)) {
      start.at.velocity = {};
      start.speed2 = 0.0;
    }
    start.acceleration = accelerate(start.sample, start.at.velocity, drive, start.contact);
    return start;
  }

 private:
  /// The drive with the site's pull in it.
  [[nodiscard, gnu::always_inline]] static inline decltype(auto) drive_at(const Site& s, const Drive& drive) {
    if constexpr (F::central) {
      Drive pulled = drive;
      pulled.pull = s.pull;
      return pulled;
    } else {
      return (drive);
    }
  }

  [[nodiscard, gnu::noinline]] core::Vec2 frictionless(const Site& s, core::Vec2 v,
                                                       const Drive& drive) const {
    return E::template acceleration<WithoutFriction<F>>(s, v, drive_at(s, drive), parameters_);
  }

  /// Friction is of what the walls leave of the load.
  [[nodiscard, gnu::noinline]] core::Vec2 accelerate_at_wall(const Site& s, core::Vec2 v, const Drive& drive,
                                                             Contact contact) const {
    if constexpr (!E::kExact || !F::friction) {
      return supported(s, contact, E::template acceleration<F>(s, v, drive_at(s, drive), parameters_));
    } else {
      core::Vec2 a = frictionless(s, v, drive);
      const double speed2 = squared_length_in_space(s, v);
      if (speed2 > kStandstill2) {
        const double w2 = 1.0 + s.zx * s.zx + s.zy * s.zy;
        const double carried = std::fabs(load(s, v, drive, contact));
        a = a - (parameters_.friction * carried / std::sqrt(w2 * speed2)) * v;
      }
      return supported(s, contact, a);
    }
  }

  const S& surface_;
  const state::Parameters& parameters_;
};

/// The motion's right side through one sub-step, as integrators ask for it.
template <typename Ground>
struct Field {
  const Ground& ground;
  const typename Ground::Start& start;
  const Drive& drive;

  [[nodiscard]] const auto& surface() const { return ground.surface(); }
  [[nodiscard, gnu::always_inline]] inline auto sample(core::Vec2 x) const { return ground.site(x); }
  /// The same for a sample that was taken otherwise.
  [[nodiscard, gnu::always_inline]] inline auto at(const typename Ground::Sample& s, core::Vec2 x) const {
    return ground.site_of(s, x);
  }
  [[nodiscard, gnu::always_inline]] inline core::Vec2 accelerate(const typename Ground::Site& s,
                                                                 core::Vec2 v) const {
    return ground.accelerate(s, v, drive, start.contact);
  }
  [[nodiscard]] core::Vec2 kick(const typename Ground::Site& s, core::Vec2 v, double k) const {
    return ground.kick(s, v, k, drive, start.contact);
  }

  /// A step's gain of energy, as a sample tells that was taken at `place`, at its end or near it.
  [[nodiscard, gnu::always_inline]] inline Gain gain(const typename Ground::Site& s, core::Vec2 place,
                                                     const Motion& end, double h) const {
    return ground.gain(start, s, place, end, h, drive.push);
  }

  /// Whether the drive acts along a heading that turns; then the same with that heading.
  [[nodiscard, gnu::always_inline]] inline bool turns() const { return Ground::kTurns && drive.turns; }
  [[nodiscard]] core::Vec2 heading() const { return drive.direction; }
  [[nodiscard]] core::Vec2 accelerate(const typename Ground::Site& s, core::Vec2 v,
                                      core::Vec2 heading) const {
    return ground.accelerate(s, v, along(heading), start.contact);
  }
  [[nodiscard]] core::Vec2 kick(const typename Ground::Site& s, core::Vec2 v, double k,
                                core::Vec2 heading) const {
    return ground.kick(s, v, k, along(heading), start.contact);
  }

  /// How far astray a step over h led [m]; a heading that turns did so as the cubic through both of its ends.
  [[nodiscard, gnu::noinline]] double astray(const StepResult& result, double h) const {
    const Motion& from = start.at;
    const core::Vec2 turned = result.heading - heading();
    const core::Vec2 r0 = h * heading_rate(heading(), from.velocity);
    const core::Vec2 r1 = h * heading_rate(result.heading, result.end.velocity);
    return physics::astray(from, start.acceleration, result.end, h, [&](double s, const Motion& at) {
      if (!turns()) return accelerate(sample(at.position), at.velocity);
      return accelerate(
          sample(at.position), at.velocity,
          heading() + s * (r0 + s * (3.0 * turned - 2.0 * r0 - r1 + s * (r0 + r1 - 2.0 * turned))));
    });
  }

 private:
  [[nodiscard]] Drive along(core::Vec2 heading) const {
    Drive turned = drive;
    point(turned, heading);
    return turned;
  }
};

}  // namespace woodlouse::physics
