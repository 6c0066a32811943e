// Every integrator and equation of the laboratory: orders, references, refusals.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "bench/lab/methods/constrained.h"
#include "bench/lab/methods/laboratory.h"
#include "tests/support/csv.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::lab;
using document::AnySurface;
using physics::StepCounters;
using terrain::FunctionName;
using terrain::FunctionSurface;
using tests::moving;

namespace {

state::Louse rolled(const AnySurface& surface, Equations equations, Integrator integrator,
                    const state::Parameters& p, state::Louse louse, double rate, double seconds) {
  const auto stepper = make_stepper(surface, equations, integrator, p, tests::kNowhere, 1.0 / rate);
  REQUIRE(stepper.has_value());
  StepCounters counters;
  const long ticks = std::lround(seconds * rate);
  for (long i = 0; i < ticks; ++i) (*stepper)->advance({&louse, 1}, counters);
  return louse;
}

double apart(const state::Louse& a, const state::Louse& b) {
  return std::hypot(a.position.x - b.position.x, a.position.y - b.position.y);
}

const state::Louse kStart = moving({0.8, 0.0}, {0.0, 1.5});
const state::Parameters kFree{.gravity = 9.81, .drag = 0.0, .friction = 0.0, .thrust_max = 0.0};

}  // namespace

TEST_CASE("each integrator converges with its order on a smooth surface") {
  const AnySurface surface = FunctionSurface(FunctionName::kHills, 1.0);
  const state::Parameters p{.gravity = 9.81, .drag = 0.3, .friction = 0.0, .thrust_max = 0.0};
  const std::map<Integrator, double> orders = {{Integrator::kExplicitEuler, 1}, {Integrator::kFalseEuler, 1},
                                               {Integrator::kVerletQ, 2},       {Integrator::kVerletQ4, 4},
                                               {Integrator::kRungeKutta4, 4},   {Integrator::kNystrom4, 4},
                                               {Integrator::kDormandPrince5, 5}};
  const state::Louse exact =
      rolled(surface, Equations::kSurface, Integrator::kDormandPrince5, p, kStart, 6400, 2);
  for (const auto& [integrator, order] : orders) {
    const double coarse_rate = order == 1 ? 3200 : (order == 5 ? 80 : 200);
    const double coarse =
        apart(rolled(surface, Equations::kSurface, integrator, p, kStart, coarse_rate, 2), exact);
    const double fine =
        apart(rolled(surface, Equations::kSurface, integrator, p, kStart, 4 * coarse_rate, 2), exact);
    INFO(to_text(integrator) << ": " << coarse << " -> " << fine);
    CHECK(std::log2(coarse / fine) / 2 == Approx(order).margin(0.3));
  }
}

TEST_CASE("each method for constrained motion converges with its order to where the exact equations lead") {
  const AnySurface surface = FunctionSurface(FunctionName::kHills, 1.0);
  const state::Louse exact =
      rolled(surface, Equations::kSurface, Integrator::kDormandPrince5, kFree, kStart, 6400, 2);
  const auto error = [&](Constrained method, double rate) {
    const auto motion =
        make_constrained(surface, method, kFree.gravity, {kStart.position, kStart.velocity}, 1.0 / rate);
    for (long tick = 0; tick < std::lround(2 * rate); ++tick) motion->step();
    return std::hypot(motion->position().x - exact.position.x, motion->position().y - exact.position.y);
  };
  const std::map<Constrained, double> orders = {
      {Constrained::kRattle, 2}, {Constrained::kRattle4, 4}, {Constrained::kSymmetric4, 4}};
  for (const auto& [method, order] : orders) {
    const double coarse = error(method, 100), fine = error(method, 400);
    INFO(to_text(method) << ": " << coarse << " -> " << fine);
    CHECK(std::log2(coarse / fine) / 2 == Approx(order).margin(0.3));
  }
}

TEST_CASE("methods for constrained motion keep to a level circle in the pot for good") {
  const AnySurface surface = FunctionSurface(FunctionName::kParabolicPot, 1.0);
  const auto ground = std::get<FunctionSurface>(surface).sample(0.5, 0.0);
  const double speed = std::sqrt(kFree.gravity * 0.5 * ground.zx);  // what a circle of that radius takes
  for (const Constrained method : kConstrained) {
    const auto motion =
        make_constrained(surface, method, kFree.gravity, {{0.5, 0.0}, {0.0, speed}}, 1.0 / 60);
    double least = 1.0, most = 0.0;
    for (int tick = 0; tick < 60 * 300; ++tick) {
      motion->step();
      const double radius = std::hypot(motion->position().x, motion->position().y);
      least = std::fmin(least, radius);
      most = std::fmax(most, radius);
    }
    INFO(to_text(method) << ": " << least << " to " << most);
    CHECK(least > 0.499);
    CHECK(most < 0.501);
  }
}

TEST_CASE("drag and friction keep the orders of those that treat them implicitly") {
  const AnySurface surface = FunctionSurface(FunctionName::kParabolicPot, 1.0);
  const state::Parameters rough{.gravity = 9.81, .drag = 0.2, .friction = 0.05, .thrust_max = 0.0};
  const state::Louse exact =
      rolled(surface, Equations::kSurface, Integrator::kDormandPrince5, rough, kStart, 6400, 1);
  for (const auto& [integrator, order] :
       std::map<Integrator, double>{{Integrator::kVerletQ, 2}, {Integrator::kNystrom4, 4}}) {
    const double coarse =
        apart(rolled(surface, Equations::kSurface, integrator, rough, kStart, 100, 1), exact);
    const double fine = apart(rolled(surface, Equations::kSurface, integrator, rough, kStart, 400, 1), exact);
    INFO(to_text(integrator) << ": " << coarse << " -> " << fine);
    CHECK(std::log2(coarse / fine) / 2 == Approx(order).margin(0.3));
  }
}

TEST_CASE("splitting at knot lines gives the spline's own order back") {
  const AnySurface surface =
      terrain::BicubicSpline(terrain::sample_function(FunctionName::kWavyPot, 1.0, 10));
  const state::Louse exact =
      rolled(surface, Equations::kSurface, Integrator::kPrecise, kFree, kStart, 3840, 2);
  const double coarse =
      apart(rolled(surface, Equations::kSurface, Integrator::kPrecise, kFree, kStart, 120, 2), exact);
  const double fine =
      apart(rolled(surface, Equations::kSurface, Integrator::kPrecise, kFree, kStart, 480, 2), exact);
  INFO(coarse << " -> " << fine);
  CHECK(std::log2(coarse / fine) / 2 > 3.5);
  const double plain =
      apart(rolled(surface, Equations::kSurface, Integrator::kRungeKutta4, kFree, kStart, 120, 2), exact);
  CHECK(coarse < 0.05 * plain);
}

TEST_CASE("Dormand-Prince meets the reference trajectories without friction to 1e-9 at 240 Hz") {
  const tests::CsvTable t = tests::read_reference("exact_trajectories.csv");
  int rows = 0;
  for (std::size_t row = 0; row < t.rows.size(); ++row) {
    if (t.number(row, "mu") != 0.0) continue;
    const AnySurface surface = FunctionSurface(*terrain::function_from_text(t.text(row, "surface")), 1.0);
    state::Louse louse =
        moving({t.number(row, "x0"), t.number(row, "y0")}, {t.number(row, "vx0"), t.number(row, "vy0")});
    louse.thrust = {t.number(row, "thrust_x"), t.number(row, "thrust_y")};
    louse.thrust_kind = state::ThrustKind::kMapVector;
    const state::Parameters p{
        .gravity = 9.81, .drag = t.number(row, "drag"), .friction = 0.0, .thrust_max = 1.0};
    const state::Louse end =
        rolled(surface, Equations::kSurface, Integrator::kDormandPrince5, p, louse, 240, t.number(row, "t"));
    INFO("row " << row);
    CHECK(std::hypot(end.position.x - t.number(row, "x"), end.position.y - t.number(row, "y")) < 1e-9);
    ++rows;
  }
  CHECK(rows > 10);
}

TEST_CASE("the energy error of Verlet-Q stays bounded without a trend") {
  const FunctionSurface wavy(FunctionName::kWavyPot, 1.0);
  const AnySurface surface = wavy;
  const double lowest = 9.81 * 0.03;  // about: the energy is measured from there
  const double before = tests::energy(wavy, kStart, 9.81) - lowest;
  double worst_early = 0.0;
  double worst_late = 0.0;
  const auto stepper =
      make_stepper(surface, Equations::kSurface, Integrator::kVerletQ, kFree, tests::kNowhere, 1.0 / 120);
  state::Louse louse = kStart;
  StepCounters counters;
  for (long i = 0; i < 120 * 1000; ++i) {
    (*stepper)->advance({&louse, 1}, counters);
    const double error = std::fabs(tests::energy(wavy, louse, 9.81) - lowest - before) / before;
    (i < 60 * 1000 ? worst_early : worst_late) = std::fmax(i < 60 * 1000 ? worst_early : worst_late, error);
  }
  CHECK(worst_early < 2e-3);
  CHECK(worst_late < 1.25 * worst_early);
}

TEST_CASE("what can't be combined is refused by name") {
  const auto grid = terrain::sample_function(FunctionName::kHills, 1.0, 5);
  const auto biquadratic = document::interpolate(document::Interpolation::kBiquadratic, grid);
  REQUIRE(biquadratic.has_value());
  const auto refused = [&](const AnySurface& s, Equations e, Integrator i) {
    const auto made = make_stepper(s, e, i, kFree, tests::kNowhere, 0.01);
    return made.has_value() ? std::string() : made.error().text();
  };
  CHECK(refused(*biquadratic, Equations::kSurface, Integrator::kNystrom4).find("Hessian") !=
        std::string::npos);
  CHECK(refused(*biquadratic, Equations::kLocalPlane, Integrator::kVerletQ).find("exact equations") !=
        std::string::npos);
  CHECK(refused(*biquadratic, Equations::kLocalPlane, Integrator::kFalseEuler).empty());
}

TEST_CASE("equations and integrators go to text and back") {
  for (const Equations e : kEquations) CHECK(equations_from_text(to_text(e)) == e);
  for (const Integrator i : kIntegrators) CHECK(integrator_from_text(to_text(i)) == i);
  CHECK_FALSE(integrator_from_text("euler").has_value());
}
