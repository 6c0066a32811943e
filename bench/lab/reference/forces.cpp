#include "bench/lab/reference/forces.h"

#include <cmath>

namespace woodlouse::lab::reference {
namespace {

struct Vector {
  Real x = 0, y = 0, z = 0;
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator*(Real s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};

Real dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Real length(Vector a) { return std::sqrt(dot(a, a)); }

/// The tangent over a direction of the map.
Vector lifted(const Place& place, Pair u) { return {u.x, u.y, place.zx * u.x + place.zy * u.y}; }

Vector normal_of(const Place& place) {
  return (1 / std::sqrt(1 + place.zx * place.zx + place.zy * place.zy)) * Vector{-place.zx, -place.zy, 1};
}

/// The pull towards the origin, smooth in its core.
Vector central_pull(Pair position, const state::Parameters& parameters) {
  if (!(parameters.central_gravity > 0.0)) return {};
  const Real r = std::hypot(position.x, position.y);
  const Real core = parameters.core_radius;
  const Real q = (r / core) * (r / core);
  const Real per_metre = r >= core ? parameters.central_gravity / (r * r * r)
                                   : parameters.central_gravity / (core * core * core) *
                                         (35.0L / 8 - 21.0L / 4 * q + 15.0L / 8 * q * q);
  return {-per_metre * position.x, -per_metre * position.y, 0};
}

/// The pushes of the ground and of the walls of a choice.
struct Pushes {
  Real normal = 0;
  Pair wall;
  Vector sum;  ///< V'
};

Pushes pushes(Vector applied, Vector n, Real along_normal, bool by_x, bool by_y) {
  Pushes result;
  // n.(A + N n + R) = along_normal, x and y of it 0 where a wall pushes: R = -A - N n there.
  Real missing = along_normal - dot(n, applied);
  Real share = 1;
  if (by_x) {
    missing += n.x * applied.x;
    share -= n.x * n.x;
  }
  if (by_y) {
    missing += n.y * applied.y;
    share -= n.y * n.y;
  }
  result.normal = missing / share;
  if (by_x) result.wall.x = -applied.x - result.normal * n.x;
  if (by_y) result.wall.y = -applied.y - result.normal * n.y;
  result.sum = applied + result.normal * n + Vector{result.wall.x, result.wall.y, 0};
  if (by_x) result.sum.x = 0;
  if (by_y) result.sum.y = 0;
  return result;
}

}  // namespace

Thrust thrust_of(const state::Thrust& thrust, Pair heading, const state::Parameters& parameters) {
  Thrust result;
  result.direction = heading;
  const Real most = parameters.thrust_max;
  if (thrust.kind == state::ThrustKind::kMapVector) {
    const Real size = std::hypot(static_cast<Real>(thrust.value.x), static_cast<Real>(thrust.value.y));
    if (size > 0) {
      result.direction = {thrust.value.x / size, thrust.value.y / size};
      result.push = size * most;
    }
  } else if (thrust.kind == state::ThrustKind::kAlongHeading) {
    const Real value = thrust.value.x;
    result.turns = value > 0;
    (value > 0 ? result.push : result.brake) = std::fabs(value) * most;
  }
  return result;
}

Acting acting(const Place& place, Pair position, Pair velocity, const Thrust& thrust, Touched pushing,
              const state::Parameters& parameters) {
  const Vector n = normal_of(place);
  const Vector v = lifted(place, velocity);
  Vector applied = Vector{0, 0, -static_cast<Real>(parameters.gravity)} + central_pull(position, parameters) +
                   (-static_cast<Real>(parameters.drag)) * v;
  if (thrust.push > 0) {
    const Vector along = lifted(place, thrust.direction);
    applied = applied + (thrust.push / length(along)) * along;
  }
  const Real bend = place.zxx * velocity.x * velocity.x + 2 * place.zxy * velocity.x * velocity.y +
                    place.zyy * velocity.y * velocity.y;
  const Pushes all = pushes(applied, n, bend * n.z, pushing.x != 0, pushing.y != 0);
  Acting result{{}, all.normal, all.wall, length(all.sum)};
  const Real speed = length(v);
  const Real resistance = parameters.friction * std::fabs(all.normal) + thrust.brake;
  const Real share = speed > 0 ? resistance / speed : 0;
  result.acceleration = {all.sum.x - share * v.x, all.sum.y - share * v.y};
  return result;
}

Touched pushing_of(const Place& place, Pair position, Pair velocity, const Thrust& thrust, Touched touched,
                   const state::Parameters& parameters) {
  for (const Touched choice : {Touched{}, Touched{touched.x, 0}, Touched{0, touched.y}}) {
    const Acting by_these = acting(place, position, velocity, thrust, choice, parameters);
    const auto is_fair = [](int wall, int chosen, Real push, Real driven) {
      return chosen != 0 ? push * wall <= 0 : driven * wall <= 0;
    };
    if (is_fair(touched.x, choice.x, by_these.wall.x, by_these.acceleration.x) &&
        is_fair(touched.y, choice.y, by_these.wall.y, by_these.acceleration.y))
      return choice;
  }
  return touched;
}

bool holds(const Acting& at_rest, const Thrust& thrust, const state::Parameters& parameters) {
  return at_rest.pull <= parameters.friction * std::fabs(at_rest.normal) + thrust.brake;
}

Real speed_in_space(const Place& place, Pair velocity) { return length(lifted(place, velocity)); }

Pair thrown_back_in_x(const Place& place, Pair u, Real restitution) {
  const Vector n = normal_of(place);
  const Real push = -(1 + restitution) * u.x / (1 - n.x * n.x);  // with that of the ground, -push n.x along n
  return {-restitution * u.x, u.y - push * n.x * n.y};
}

Pair thrown_back_in_y(const Place& place, Pair u, Real restitution) {
  const Vector n = normal_of(place);
  const Real push = -(1 + restitution) * u.y / (1 - n.y * n.y);
  return {u.x - push * n.y * n.x, -restitution * u.y};
}

}  // namespace woodlouse::lab::reference
