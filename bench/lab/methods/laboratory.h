// Every surface, equation and integrator by name, for whoever compares them.
//
// Compiled outright: the exact equations and every integrator over the function surface and the bicubic
// spline; those that rooms have are the rooms' own steps. The rest samples its surface through one indirect
// call a point.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "shared/core/error.h"
#include "shared/document/surface_catalogue.h"
#include "shared/physics/ground_steps.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"

namespace woodlouse::lab {

enum class Equations { kSurface, kLocalPlane, kAsPrinted };
enum class Integrator {
  kExplicitEuler,
  kFalseEuler,
  kVerletQ,
  kVerletQ4,
  kRungeKutta4,
  kNystrom4,
  kDormandPrince5,
  kPrecise,
};

inline constexpr std::array kEquations = {Equations::kSurface, Equations::kLocalPlane, Equations::kAsPrinted};
inline constexpr std::array kIntegrators = {
    Integrator::kExplicitEuler, Integrator::kFalseEuler, Integrator::kVerletQ,        Integrator::kVerletQ4,
    Integrator::kRungeKutta4,   Integrator::kNystrom4,   Integrator::kDormandPrince5, Integrator::kPrecise};

/// surface, local_plane, as_printed.
std::string_view to_text(Equations equations);
/// explicit_euler, false_euler, verlet_q, verlet_q4, rk4, nystrom4, dopri5, precise.
std::string_view to_text(Integrator integrator);
std::optional<Equations> equations_from_text(std::string_view text);
std::optional<Integrator> integrator_from_text(std::string_view text);

/// The method that a room would step with; nothing: no room has that integrator.
inline std::optional<state::Method> room_method(Integrator integrator) {
  switch (integrator) {
    case Integrator::kNystrom4:
      return state::Method::kStandard;
    case Integrator::kVerletQ:
      return state::Method::kCheap;
    case Integrator::kPrecise:
      return state::Method::kPrecise;
    default:
      return std::nullopt;
  }
}

/// One choice of all of them, ready to step lice. One thread at a time.
class LaboratoryStepper {
 public:
  explicit LaboratoryStepper(std::unique_ptr<const physics::GroundSteps> steps) : steps_(std::move(steps)) {}

  /// Moves each louse that is not at rest through one tick. Thrusts are not counted down.
  void advance(std::span<state::Louse> lice, physics::StepCounters& counters) const;

 private:
  std::unique_ptr<const physics::GroundSteps> steps_;
  mutable std::vector<std::uint32_t> moving_;  ///< room for lists, kept from call to call
  mutable physics::BatchLists lists_;
  mutable std::vector<state::StepEvents> events_;
};

/// walls: where lice are kept, infinite: nowhere; tick: [s]. `surface` must outlive the stepper. Errors: the
/// exact equations on a surface without a Hessian; verlet_q and verlet_q4 with the document's equations,
/// which have no closed-form implicit kick; precise on a surface without polynomial cells.
core::Expected<std::unique_ptr<LaboratoryStepper>> make_stepper(const document::AnySurface& surface,
                                                                Equations equations, Integrator integrator,
                                                                const state::Parameters& parameters,
                                                                const terrain::Rectangle& walls, double tick);

}  // namespace woodlouse::lab
