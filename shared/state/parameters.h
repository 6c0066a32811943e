// What a map says about its physics, per unit mass.
#pragma once

#include <optional>
#include <string_view>

namespace woodlouse::state {

/// Whether a louse can leave the surface.
enum class SurfaceContact {
  kBilateral,   ///< a bead on a wire: it never does, friction takes |N|
  kUnilateral,  ///< where N would be negative it flies, and lands (flight.h)
};

/// What a louse meets at the map's rim (rim.h).
enum class Edges {
  kWalls,  ///< four walls: it bounces
  kWrap,   ///< the opposite rim: the map goes on without end; the terrain must be periodic
  kOpen,   ///< nothing: its motion ends there
};

/// What a louse obeys.
enum class Equations {
  kExact,       ///< Lagrange's, with the surface's curvature
  kLocalPlane,  ///< the paper's, Cramer's factors put right (chapter 1.1)
  kAsPrinted,   ///< the paper's as its source code has them (chapter 2.4)
};

/// How a tick is integrated (integrators.h, precise.h, document/euler.h); the error and cost of each are in
/// docs/physics.md. kFalseEuler is the paper's and goes with its equations, the others with the exact ones.
enum class Method {
  kStandard,    ///< Nystrom-4: the best accuracy for its time
  kCheap,       ///< Verlet-Q: one surface call, order 2, no energy trend
  kPrecise,     ///< Nystrom-4 split at the spline's knot lines: order 4 across cells
  kFalseEuler,  ///< one surface call, order 1
};

constexpr std::string_view to_text(SurfaceContact contact) {
  return contact == SurfaceContact::kUnilateral ? "unilateral" : "bilateral";
}
constexpr std::string_view to_text(Equations equations) {
  return equations == Equations::kLocalPlane  ? "local_plane"
         : equations == Equations::kAsPrinted ? "as_printed"
                                              : "exact";
}
constexpr std::string_view to_text(Method method) {
  switch (method) {
    case Method::kCheap:
      return "cheap";
    case Method::kPrecise:
      return "precise";
    case Method::kFalseEuler:
      return "false_euler";
    case Method::kStandard:
      break;
  }
  return "standard";
}
constexpr std::string_view to_text(Edges edges) {
  return edges == Edges::kWrap ? "wrap" : edges == Edges::kOpen ? "open" : "walls";
}
constexpr std::optional<Edges> edges_from_text(std::string_view text) {
  for (const Edges edges : {Edges::kWalls, Edges::kWrap, Edges::kOpen}) {
    if (to_text(edges) == text) return edges;
  }
  return std::nullopt;
}
constexpr std::optional<SurfaceContact> contact_from_text(std::string_view text) {
  for (const SurfaceContact contact : {SurfaceContact::kBilateral, SurfaceContact::kUnilateral}) {
    if (to_text(contact) == text) return contact;
  }
  return std::nullopt;
}
constexpr std::optional<Equations> equations_from_text(std::string_view text) {
  for (const Equations equations : {Equations::kExact, Equations::kLocalPlane, Equations::kAsPrinted}) {
    if (to_text(equations) == text) return equations;
  }
  return std::nullopt;
}
constexpr std::optional<Method> method_from_text(std::string_view text) {
  for (const Method method : {Method::kStandard, Method::kCheap, Method::kPrecise, Method::kFalseEuler}) {
    if (to_text(method) == text) return method;
  }
  return std::nullopt;
}

struct Parameters {
  double gravity = 9.81;          ///< g [m/s^2], >= 0
  double drag = 0.2;              ///< viscous drag d [1/s], >= 0; 0 costs nothing
  double friction = 0.05;         ///< Coulomb coefficient mu [1], >= 0; 0 costs nothing
  double thrust_max = 4.0;        ///< acceleration of a thrust of 1 [m/s^2], >= 0; 0 costs nothing
  double edge_restitution = 0.5;  ///< walls at the domain's edge: 0 no bounce .. 1 elastic

  /// Pull towards the map's origin, k / r^2 [m^3/s^2], >= 0 (chapter 2.3); 0 costs nothing.
  double central_gravity = 0.0;
  /// Within it the pull is smooth and ends at the origin (physics/central_gravity.h) [m]. REQUIRED > 0 where
  /// there is central gravity; counts nowhere else.
  double core_radius = 0.0;
  /// How far astray its steps may lead a louse [m/s of play], >= 0: they are shortened until they bear it, in
  /// a tick down to a 128th (physics/sub_step_rules.h). 0: no step asks, and it costs nothing.
  double tolerance = 0.0;
  Edges edges = Edges::kWalls;
  SurfaceContact contact = SurfaceContact::kBilateral;
  Equations equations = Equations::kExact;
  Method method = Method::kStandard;

  friend bool operator==(const Parameters&, const Parameters&) = default;
};

}  // namespace woodlouse::state
