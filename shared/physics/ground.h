// What acts on a louse at a place: the surface's sample there, the equations E with the map's forces F, and
// the walls that it leans on. An integrator (integrators.h) asks for it through a Field, one for each
// sub-step.
#pragma once

#include <type_traits>
#include <utility>

#include "shared/physics/nystrom.h"
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

  /// What a sub-step knows of its start.
  struct Start {
    Motion at;
    Site sample;
    core::Vec2 acceleration;
    double speed2 = 0.0;  ///< |v|3^2
    Contact contact;      ///< the walls it may lean on: no velocity along their normals
  };

  Ground(const S& surface, const state::Parameters& parameters)
      : surface_(surface), parameters_(parameters) {}

  [[nodiscard]] const S& surface() const { return surface_; }

  [[nodiscard, gnu::always_inline]] inline Site site_of(const Sample& s, core::Vec2 x) const {
    if constexpr (F::central) {
      return {s, -central_pull(x, parameters_.central_gravity) * x};
    } else {
      return s;
    }
  }

  [[nodiscard, gnu::always_inline]] inline Site site(core::Vec2 x) const {
    return site_of(surface_.sample(x.x, x.y), x);
  }

  [[nodiscard, gnu::always_inline]] inline core::Vec2 accelerate(const Site& s, core::Vec2 v,
                                                                 const Drive& drive, Contact contact) const {
    const core::Vec2 a = E::template acceleration<F>(s, v, drive_at(s, drive), parameters_);
    return contact.any() ? supported(s, contact, a) : a;
  }

  /// v after the implicit half kick v' = v + k a(s, v').
  [[nodiscard]] core::Vec2 kick(const Site& s, core::Vec2 v, double k, const Drive& drive,
                                Contact contact) const requires E::kExact {
    const core::Vec2 kicked = implicit_kick<F>(s, v, k, drive_at(s, drive), parameters_);
    return contact.any() ? bounced(s, contact, kicked, 0.0) : kicked;
  }

  /// What pulls at v = 0, and what friction can hold there.
  [[nodiscard]] RestingBalance balance(const Start& start, core::Vec2 heading, const Drive& drive) const {
    RestingBalance b = resting_balance<F>(start.sample, heading, drive_at(start.sample, drive), parameters_);
    if (start.contact.any()) b.pull = supported(start.sample, start.contact, b.pull);
    return b;
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
};

}  // namespace woodlouse::physics
