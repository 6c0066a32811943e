// The document's own stepping against the document's own trajectories.
#include "shared/document/steps.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>

#include "shared/terrain/function_surface.h"
#include "tests/support/csv.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::document;
using tests::moving;

namespace {

constexpr std::array kEveryEquations = {state::Equations::kLocalPlane, state::Equations::kAsPrinted};
constexpr std::array kEveryIntegrator = {Integrator::kExplicitEuler, Integrator::kFalseEuler};

void advance(const physics::GroundSteps& steps, state::Louse& louse, long ticks) {
  const std::array<std::uint32_t, 1> all = {0};
  physics::BatchLists lists;
  physics::StepCounters counters;
  state::StepEvents happened = 0;
  for (long i = 0; i < ticks; ++i) steps.advance({&louse, 1}, all, {}, lists, counters, {&happened, 1});
}

}  // namespace

TEST_CASE("the document's equations and False Euler give the document's trajectories to 1e-9") {
  const tests::CsvTable t = tests::read_reference("seed_trajectories.csv");
  const std::map<std::string, Interpolation> surfaces = {{"spline", Interpolation::kNaturalDocument},
                                                         {"biquadratic", Interpolation::kBiquadratic},
                                                         {"blended", Interpolation::kBlendedDocument}};
  const physics::StepRules rules{
      {.gravity = 9.81, .drag = 0.2, .friction = 0.05, .thrust_max = 0.0}, tests::kNowhere, 1.0 / 200};
  int inside = 0;
  for (std::size_t row = 0; row < t.rows.size(); ++row) {
    // The document checks no bounds: where a stencil reaches over the rim its numbers mean nothing.
    if (std::fabs(t.number(row, "x")) > 0.9 || std::fabs(t.number(row, "y")) > 0.9) continue;
    ++inside;
    INFO("row " << row << " " << t.text(row, "surface") << " " << t.text(row, "method"));
    const auto grid = terrain::sample_function(*terrain::function_from_text(t.text(row, "surface")), 1.0,
                                               static_cast<std::size_t>(t.number(row, "g")));
    const auto surface = interpolate(surfaces.at(t.text(row, "method")), grid);
    REQUIRE(surface.has_value());
    const state::Equations equations =
        t.number(row, "corrected_cramer") != 0 ? state::Equations::kLocalPlane : state::Equations::kAsPrinted;
    state::Louse end = moving({0.35, -0.2}, {0.3, 0.4});
    advance(*make_steps(*surface, equations, Integrator::kFalseEuler, rules), end,
            std::lround(t.number(row, "step")));
    CHECK(end.position.x == Approx(t.number(row, "x")).margin(1e-9).epsilon(0));
    CHECK(end.position.y == Approx(t.number(row, "y")).margin(1e-9).epsilon(0));
    CHECK(end.velocity.x == Approx(t.number(row, "vx")).margin(1e-9).epsilon(0));
    CHECK(end.velocity.y == Approx(t.number(row, "vy")).margin(1e-9).epsilon(0));
  }
  CHECK(inside > 180);
}

TEST_CASE("one step by hand: explicit Euler drifts with the old velocity, False Euler with the new") {
  // Without drag, friction and thrust a = -g G / w^2, by whichever factors.
  const AnySurface surface = terrain::FunctionSurface(terrain::FunctionName::kParabolicPot, 1.0);
  const auto s = std::get<terrain::FunctionSurface>(surface).sample(0.3, 0.4);
  const double w2 = 1.0 + s.zx * s.zx + s.zy * s.zy;
  const core::Vec2 a{-9.81 * s.zx / w2, -9.81 * s.zy / w2};
  const double h = 1.0 / 64;
  const physics::StepRules rules{
      {.gravity = 9.81, .drag = 0.0, .friction = 0.0, .thrust_max = 0.0}, tests::kNowhere, h};
  const core::Vec2 v0{1.0, -2.0};
  for (const state::Equations equations : kEveryEquations) {
    state::Louse plain = moving({0.3, 0.4}, v0), paper = plain;
    advance(*make_steps(surface, equations, Integrator::kExplicitEuler, rules), plain, 1);
    advance(*make_steps(surface, equations, Integrator::kFalseEuler, rules), paper, 1);
    CHECK(plain.position.x == Approx(0.3 + h * v0.x).epsilon(1e-15));
    CHECK(plain.velocity.x == Approx(v0.x + h * a.x).epsilon(1e-14));
    CHECK(paper.velocity == plain.velocity);
    CHECK(paper.position.y == Approx(0.4 + h * (v0.y + h * a.y)).epsilon(1e-14));
  }
}

TEST_CASE("the document's lice never rest: nothing holds one, and one at rest is set off") {
  const AnySurface surface = terrain::FunctionSurface(terrain::FunctionName::kParabolicPot, 1.0);
  const physics::StepRules rules{
      {.gravity = 9.81, .drag = 0.2, .friction = 2.0, .thrust_max = 0.0}, tests::kNowhere, 1.0 / 60};
  for (const state::Equations equations : kEveryEquations) {
    for (const Integrator integrator : kEveryIntegrator) {
      const auto steps = make_steps(surface, equations, integrator, rules);
      state::Louse louse = moving({0.1, 0.0}, {0.0, 0.0});
      CHECK_FALSE(steps->holds(louse));
      advance(*steps, louse, 1);
      CHECK(louse.phase == state::Phase::kMoving);
      CHECK(louse.velocity.x < 0.0);
    }
  }
}
