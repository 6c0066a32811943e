#include "bench/lab/methods/laboratory.h"

#include <cstddef>
#include <string>
#include <variant>

#include "bench/lab/methods/steps.h"

namespace woodlouse::lab {
namespace {

template <typename E, std::size_t kCount, typename ToText>
std::optional<E> from_text(const std::array<E, kCount>& all, std::string_view text, ToText to_text) {
  for (const E one : all) {
    if (to_text(one) == text) return one;
  }
  return std::nullopt;
}

Steps exact(const document::AnySurface& surface, Integrator integrator, const physics::StepRules& rules) {
  if (const auto* spline = std::get_if<terrain::BicubicSpline>(&surface)) {
    return exact_steps(*spline, integrator, rules);
  }
  if (const auto* function = std::get_if<terrain::FunctionSurface>(&surface)) {
    return exact_steps(*function, integrator, rules);
  }
  return exact_steps(surface, integrator, rules);
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

void LaboratoryStepper::advance(std::span<state::Louse> lice, physics::StepCounters& counters) const {
  moving_.clear();
  for (std::size_t i = 0; i < lice.size(); ++i) {
    if (lice[i].phase != state::Phase::kResting) moving_.push_back(static_cast<std::uint32_t>(i));
  }
  events_.assign(lice.size(), 0);
  steps_->advance(lice, moving_, {}, lists_, counters, events_);
}

core::Expected<std::unique_ptr<LaboratoryStepper>> make_stepper(const document::AnySurface& surface,
                                                                Equations equations, Integrator integrator,
                                                                const state::Parameters& parameters,
                                                                const terrain::Rectangle& walls,
                                                                double tick) {
  const bool is_exact = equations == Equations::kSurface;
  if (is_exact && !document::has_hessian(surface)) {
    return core::fail("surface", "it has no Hessian, which the exact equations need",
                      "take --equations local_plane, or a spline surface");
  }
  const physics::StepRules rules{parameters, walls, tick};
  Steps steps =
      is_exact ? exact(surface, integrator, rules) : document_steps(surface, equations, integrator, rules);
  if (steps != nullptr) return std::make_unique<LaboratoryStepper>(std::move(steps));
  const std::string name(to_text(integrator));
  return integrator == Integrator::kPrecise
             ? core::fail(name, "needs a surface of polynomial cells and the exact equations",
                          "take nystrom4")
             : core::fail(name, "needs the exact equations for its implicit kick", "take false_euler or rk4");
}

}  // namespace woodlouse::lab
