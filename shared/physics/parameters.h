// What a map says about its physics, per unit mass.
#pragma once

namespace woodlouse::physics {

struct Parameters {
  double gravity = 9.81;           ///< g [m/s^2], >= 0
  double drag = 0.2;               ///< viscous drag d [1/s], >= 0; 0 costs nothing
  double friction = 0.05;          ///< Coulomb coefficient mu [1], >= 0; 0 costs nothing
  double thrust_max = 4.0;         ///< acceleration of a thrust of 1 [m/s^2], >= 0; 0 costs nothing
  double edge_restitution = 0.5;   ///< walls at the domain's edge: 0 no bounce .. 1 elastic

  friend bool operator==(const Parameters&, const Parameters&) = default;
};

}  // namespace woodlouse::physics
