#include "shared/document/game.h"

#include <cassert>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "shared/document/equations.h"
#include "shared/document/euler.h"
#include "shared/document/indirect_surface.h"
#include "shared/physics/compiled_steps.h"

namespace woodlouse::document {
namespace {

/// The document's choice, its speed kept finite.
struct GameEuler {
  static constexpr int kSamples = 0;
  static constexpr bool kSubSteps = false;
  static constexpr bool kKeepsEnergy = false;
  template <typename Start, typename Field>
  physics::StepResult step(const Start& start, const Field& field, double h) const {
    core::Vec2 v = start.at.velocity + h * start.acceleration;
    const double speed2 = dot(v, v);
    if (speed2 > kMaxGameSpeed * kMaxGameSpeed) v = (kMaxGameSpeed / std::sqrt(speed2)) * v;
    return physics::plain_result(start, field, {start.at.position + h * v, v}, h);
  }
};

/// What a map does not have is 0 and does nothing; a set of its own for each would only take longer to
/// compile.
using GameForces = physics::Forces<true, true, true>;

/// A map's ground behind one indirect call a sample, so that steps on all of them are compiled once.
class GroundView {
 public:
  explicit GroundView(const terrain::Terrain& ground) : ground_(ground) {}
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    return std::visit([&](const auto& s) { return terrain::SurfaceSample{s.sample(x, y)}; },
                      ground_.surface());
  }
  [[nodiscard]] terrain::Rectangle domain() const { return ground_.domain(); }
  [[nodiscard]] double cell() const {
    return std::visit([](const auto& s) { return s.cell(); }, ground_.surface());
  }

 private:
  const terrain::Terrain& ground_;
};

template <typename E>
class StepsOnView final : public physics::GroundSteps {
 public:
  StepsOnView(const terrain::Terrain& ground, const physics::StepRules& rules)
      : view_(ground), steps_(view_, rules) {}
  void advance(std::span<state::Louse> lice, std::span<const std::uint32_t> moving,
               const physics::BatchStep& batch, physics::BatchLists& lists, physics::StepCounters& counters,
               std::span<state::StepEvents> events) const override {
    steps_.advance(lice, moving, batch, lists, counters, events);
  }
  [[nodiscard]] bool holds(const state::Louse& louse) const override { return steps_.holds(louse); }

 private:
  GroundView view_;
  physics::CompiledSteps<GroundView, GameForces, GameEuler, E> steps_;
};

template <typename S>
std::unique_ptr<const physics::GroundSteps> game_steps_on(const S& ground, const physics::StepRules& rules) {
  if (rules.parameters.equations == state::Equations::kLocalPlane)
    return std::make_unique<const physics::CompiledSteps<S, GameForces, GameEuler, LocalPlane>>(ground,
                                                                                                rules);
  return std::make_unique<const physics::CompiledSteps<S, GameForces, GameEuler, AsPrinted>>(ground, rules);
}

template <typename S, typename... Ones>
constexpr bool kIsOneOf = (std::is_same_v<S, Ones> || ...);

void check(const state::Parameters& parameters) {
  assert(parameters.equations != state::Equations::kExact);
  assert(parameters.central_gravity == 0.0 && parameters.contact == state::SurfaceContact::kBilateral);
}

class TerrainSurface final : public terrain::AbstractSurface {
 public:
  explicit TerrainSurface(std::shared_ptr<const AnySurface> surface)
      : surface_(std::move(surface)), view_(*surface_) {}
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const override {
    return view_.sample(x, y);
  }
  [[nodiscard]] terrain::Rectangle domain() const override { return view_.domain(); }
  [[nodiscard]] double cell() const override { return view_.cell(); }

 private:
  std::shared_ptr<const AnySurface> surface_;
  IndirectSurface view_;
};

}  // namespace

std::shared_ptr<const terrain::AbstractSurface> as_terrain(std::shared_ptr<const AnySurface> surface) {
  assert(surface != nullptr);
  return std::make_shared<const TerrainSurface>(std::move(surface));
}

std::unique_ptr<const physics::GroundSteps> make_game_steps(const terrain::Terrain& ground,
                                                            const physics::StepRules& rules) {
  check(rules.parameters);
  if constexpr (physics::kFewSteps) {
    if (rules.parameters.equations == state::Equations::kLocalPlane)
      return std::make_unique<const StepsOnView<LocalPlane>>(ground, rules);
    return std::make_unique<const StepsOnView<AsPrinted>>(ground, rules);
  } else {
    return std::visit(
        [&]<typename S>(const S& surface) -> std::unique_ptr<const physics::GroundSteps> {
          if constexpr (kIsOneOf<S, terrain::BicubicSpline, terrain::FunctionSurface,
                                 terrain::PlaneSurface>) {
            return game_steps_on(surface, rules);
          } else {
            assert(false);
            return nullptr;
          }
        },
        ground.surface());
  }
}

std::unique_ptr<const physics::GroundSteps> make_game_steps(const AnySurface& ground,
                                                            const physics::StepRules& rules) {
  check(rules.parameters);
  if constexpr (physics::kFewSteps) {
    return game_steps_on(ground, rules);
  } else {
    return std::visit(
        [&]<typename S>(const S& surface) -> std::unique_ptr<const physics::GroundSteps> {
          if constexpr (kIsOneOf<S, Spline, Biquadratic, Blended, BlendedDocument, GaussGradient>) {
            return game_steps_on(surface, rules);
          } else {
            assert(false);
            return nullptr;
          }
        },
        ground);
  }
}

}  // namespace woodlouse::document
