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
  return std::visit(
      [&]<typename S>(const S& surface) -> std::unique_ptr<const physics::GroundSteps> {
        if constexpr (kIsOneOf<S, terrain::BicubicSpline, terrain::FunctionSurface, terrain::PlaneSurface>) {
          return game_steps_on(surface, rules);
        } else {
          assert(false);
          return nullptr;
        }
      },
      ground.surface());
}

std::unique_ptr<const physics::GroundSteps> make_game_steps(const AnySurface& ground,
                                                            const physics::StepRules& rules) {
  check(rules.parameters);
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

}  // namespace woodlouse::document
