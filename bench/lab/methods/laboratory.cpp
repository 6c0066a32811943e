#include "bench/lab/methods/laboratory.h"

#include <string>
#include <type_traits>
#include <variant>

#include "shared/document/document_equations.h"
#include "shared/physics/integrators.h"
#include "shared/physics/precise.h"
#include "shared/physics/stepper.h"

namespace woodlouse::physics {
namespace {

using terrain::AnySurface;
using terrain::FunctionSurface;

/// A surface behind one indirect call, so that not every combination is compiled.
class IndirectSurface {
 public:
  explicit IndirectSurface(const AnySurface& surface) : surface_(surface) {}
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    return std::visit([&](const auto& s) { return s.sample(x, y); }, surface_);
  }
  [[nodiscard]] terrain::Rectangle domain() const {
    return std::visit([](const auto& s) { return s.domain(); }, surface_);
  }
  [[nodiscard]] double cell() const {
    return std::visit([](const auto& s) { return s.cell(); }, surface_);
  }

 private:
  const AnySurface& surface_;
};

template <typename S, typename F, typename E, typename I>
class Compiled final : public LaboratoryStepper {
 public:
  Compiled(S surface, const state::Parameters& parameters, const terrain::Rectangle& walls, double tick)
      : surface_(surface), parameters_(parameters), walls_(walls), tick_(tick) {}
  void advance(std::span<state::Louse> lice, StepCounters& counters) const override {
    const Stepper<std::remove_cvref_t<S>, F, E, I> stepper(surface_, parameters_, walls_, tick_);
    for (state::Louse& louse : lice) {
      if (louse.phase != state::Phase::kResting) stepper.advance(louse, counters);
    }
  }

 private:
  S surface_;  // a reference for those that are compiled outright
  state::Parameters parameters_;
  terrain::Rectangle walls_;
  double tick_;
};

struct Choice {
  const state::Parameters& parameters;
  const terrain::Rectangle& walls;
  double tick;
};

template <typename S, typename E, typename I>
std::unique_ptr<LaboratoryStepper> with_forces(S surface, const Choice& c) {
  if (c.parameters.central_gravity > 0.0) {
    return std::make_unique<Compiled<S, Forces<true, true, true, true>, E, I>>(surface, c.parameters, c.walls,
                                                                               c.tick);
  }
  if constexpr (E::kExact) {
    if (conserves_energy(c.parameters)) {
      return std::make_unique<Compiled<S, Forces<false, false, false>, E, I>>(surface, c.parameters, c.walls,
                                                                              c.tick);
    }
  }
  // Friction asks for more than arithmetic (stops, sub-steps): it is compiled out where there is none.
  if (c.parameters.friction > 0.0) {
    return std::make_unique<Compiled<S, Forces<true, true, true>, E, I>>(surface, c.parameters, c.walls,
                                                                         c.tick);
  }
  return std::make_unique<Compiled<S, Forces<true, false, true>, E, I>>(surface, c.parameters, c.walls,
                                                                        c.tick);
}

/// S: how the stepper keeps the surface, a reference or a value.
template <typename E, typename S>
std::unique_ptr<LaboratoryStepper> with_integrator(S surface, Integrator integrator, const Choice& c) {
  switch (integrator) {
    case Integrator::kExplicitEuler:
      return with_forces<S, E, ExplicitEuler>(surface, c);
    case Integrator::kFalseEuler:
      return with_forces<S, E, FalseEuler>(surface, c);
    case Integrator::kRungeKutta4:
      return with_forces<S, E, RungeKutta4>(surface, c);
    case Integrator::kNystrom4:
      return with_forces<S, E, Nystrom4>(surface, c);
    case Integrator::kDormandPrince5:
      return with_forces<S, E, DormandPrince5>(surface, c);
    case Integrator::kVerletQ:
      if constexpr (E::kExact) return with_forces<S, E, VerletQ>(surface, c);
      break;
    case Integrator::kVerletQ4:
      if constexpr (E::kExact) return with_forces<S, E, VerletQ4>(surface, c);
      break;
    case Integrator::kPrecise:
      if constexpr (E::kExact && !std::is_same_v<std::remove_cvref_t<S>, IndirectSurface>) {
        return with_forces<S, E, Precise>(surface, c);
      }
      break;
  }
  return nullptr;
}

std::unique_ptr<LaboratoryStepper> exact(const AnySurface& surface, Integrator integrator, const Choice& c) {
  if (const auto* spline = std::get_if<terrain::BicubicSpline>(&surface)) {
    return with_integrator<SurfaceEquations, const terrain::BicubicSpline&>(*spline, integrator, c);
  }
  if (const auto* function = std::get_if<terrain::FunctionSurface>(&surface)) {
    return with_integrator<SurfaceEquations, const FunctionSurface&>(*function, integrator, c);
  }
  return with_integrator<SurfaceEquations, IndirectSurface>(IndirectSurface(surface), integrator, c);
}

template <typename E, std::size_t kCount, typename ToText>
std::optional<E> from_text(const std::array<E, kCount>& all, std::string_view text, ToText to_text) {
  for (const E one : all) {
    if (to_text(one) == text) return one;
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_text(Equations equations) {
  switch (equations) {
    case Equations::kSurface:
      return "surface";
    case Equations::kLocalPlane:
      return "local_plane";
    default:
      return "as_printed";
  }
}

std::string_view to_text(Integrator integrator) {
  switch (integrator) {
    case Integrator::kExplicitEuler:
      return "explicit_euler";
    case Integrator::kFalseEuler:
      return "false_euler";
    case Integrator::kVerletQ:
      return "verlet_q";
    case Integrator::kVerletQ4:
      return "verlet_q4";
    case Integrator::kRungeKutta4:
      return "rk4";
    case Integrator::kNystrom4:
      return "nystrom4";
    case Integrator::kDormandPrince5:
      return "dopri5";
    default:
      return "precise";
  }
}

std::optional<Equations> equations_from_text(std::string_view text) {
  return from_text(kEquations, text, [](Equations e) { return to_text(e); });
}

std::optional<Integrator> integrator_from_text(std::string_view text) {
  return from_text(kIntegrators, text, [](Integrator i) { return to_text(i); });
}

core::Expected<std::unique_ptr<LaboratoryStepper>> make_stepper(const AnySurface& surface,
                                                                Equations equations, Integrator integrator,
                                                                const state::Parameters& parameters,
                                                                const terrain::Rectangle& walls,
                                                                double tick) {
  const Choice choice{parameters, walls, tick};
  std::unique_ptr<LaboratoryStepper> stepper;
  if (equations == Equations::kSurface) {
    if (!terrain::has_hessian(surface)) {
      return core::fail("surface", "it has no Hessian, which the exact equations need",
                        "take --equations local_plane, or a spline surface");
    }
    stepper = exact(surface, integrator, choice);
  } else if (equations == Equations::kLocalPlane) {
    stepper = with_integrator<LocalPlane, IndirectSurface>(IndirectSurface(surface), integrator, choice);
  } else {
    stepper = with_integrator<AsPrinted, IndirectSurface>(IndirectSurface(surface), integrator, choice);
  }
  if (stepper == nullptr) {
    const std::string name(to_text(integrator));
    return integrator == Integrator::kPrecise
               ? core::fail(name, "needs a surface of polynomial cells and the exact equations",
                            "take nystrom4")
               : core::fail(name, "needs the exact equations for its implicit kick",
                            "take false_euler or rk4");
  }
  return stepper;
}

}  // namespace woodlouse::physics
