// What contact and central gravity cost a louse-step: the laboratory's, one louse after the other, and the
// room's, which has no lanes for either. Flat ground is a surface that only rooms have.
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/methods/laboratory.h"
#include "bench/lab/precision_flight.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/report/race.h"
#include "shared/core/random.h"
#include "shared/physics/central_gravity.h"
#include "shared/physics/world.h"

namespace woodlouse::lab {
namespace {

using state::SurfaceContact;

constexpr double kScale = 20.0;
constexpr double kTick = 1.0 / 60.0;
constexpr int kTicks = 20;
constexpr std::uint32_t kLice = 200;
constexpr double kSky = 1000.0;  // [m]; nobody lands from there within the ticks

/// As the shipped map of jumps has them.
state::Parameters parameters(SurfaceContact contact, double central_gravity = 0.0) {
  state::Parameters p{4.0, 0.1, 0.02, 6.0, 0.5};
  p.contact = contact;
  p.central_gravity = central_gravity;
  if (central_gravity > 0.0) p.core_radius = physics::default_core_radius(central_gravity);
  return p;
}

/// Lice well inside, each pushed in a direction of its own; slow enough to stay on the ground.
std::vector<state::Louse> gliding() {
  core::Random random(2);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  std::vector<state::Louse> lice;
  for (std::uint32_t id = 1; id <= kLice; ++id) {
    state::Louse louse = louse_at({symmetric(12), symmetric(12)}, {symmetric(1), symmetric(1)});
    louse.id = id;
    const double angle = symmetric(std::numbers::pi);
    push(louse, {std::cos(angle), std::sin(angle)});
    lice.push_back(louse);
  }
  return lice;
}

std::vector<state::Louse> flying(double speed) {
  std::vector<state::Louse> lice = gliding();
  for (state::Louse& louse : lice) {
    louse.phase = state::Phase::kFlying;
    louse.flight_z = kSky;
    louse.velocity = speed * louse.thrust;
  }
  return lice;
}

enum class GroundKind { kHills, kFlat };

struct Case {
  std::string name;
  std::vector<state::Louse> start;
  state::Parameters parameters;
  GroundKind ground = GroundKind::kHills;
};

std::vector<Case> cases() {
  return {{"gliding, bilateral", gliding(), parameters(SurfaceContact::kBilateral)},
          {"gliding, unilateral", gliding(), parameters(SurfaceContact::kUnilateral)},
          {"flying at 1 m/s", flying(1.0), parameters(SurfaceContact::kUnilateral)},
          {"flying at 15 m/s", flying(15.0), parameters(SurfaceContact::kUnilateral)},
          {"gliding, central gravity", gliding(), parameters(SurfaceContact::kBilateral, 100.0)},
          {"flat ground", gliding(), parameters(SurfaceContact::kBilateral), GroundKind::kFlat},
          {"flat ground, central gravity", gliding(), parameters(SurfaceContact::kBilateral, 100.0),
           GroundKind::kFlat}};
}

/// Steps the same lice through the same ticks, again and again.
struct Runner {
  std::string name;
  std::function<physics::StepCounters()> run;
};

core::Expected<Runner> one_by_one(const Case& one, const document::AnySurface& ground) {
  auto made =
      make_stepper(ground, Equations::kSurface, Integrator::kNystrom4, one.parameters, kNowhere, kTick);
  if (!made) return tl::unexpected(made.error());
  return Runner{"one after the other",
                [stepper = std::shared_ptr<const LaboratoryStepper>(std::move(*made)), &one] {
                  std::vector<state::Louse> lice = one.start;
                  physics::StepCounters counters;
                  for (int i = 0; i < kTicks; ++i) stepper->advance(lice, counters);
                  keep(lice.front());
                  return counters;
                }};
}

Runner room(const Case& one, const std::shared_ptr<const terrain::Terrain>& ground) {
  const auto world = std::make_shared<physics::World>(ground, one.parameters, kTick);
  return {"room", [world, &one] {
            world->restore(one.start);
            for (int i = 0; i < kTicks; ++i) world->step();
            return world->counters();
          }};
}

}  // namespace

core::Expected<void> measure_flight_cost(const Output& output) {
  const terrain::BicubicSpline spline(terrain::sample_function(terrain::FunctionName::kHills, kScale, 10));
  const document::AnySurface any(spline);
  const auto hills = std::make_shared<const terrain::Terrain>(spline);
  const auto flat = std::make_shared<const terrain::Terrain>(terrain::PlaneSurface(hills->domain(), 0.0, {}));
  const std::vector<Case> all = cases();
  std::vector<std::pair<const Case*, Runner>> runners;
  for (const Case& one : all) {
    if (one.ground == GroundKind::kHills) {
      auto alone = one_by_one(one, any);
      if (!alone) return tl::unexpected(alone.error());
      runners.emplace_back(&one, std::move(*alone));
    }
    runners.emplace_back(&one, room(one, one.ground == GroundKind::kHills ? hills : flat));
  }
  std::vector<Contestant> contestants;
  for (const auto& entry : runners)
    contestants.push_back({"", [&run = entry.second.run] { run(); }, kLice * double{kTicks}});
  const std::vector<Timing> times = race(contestants, output.effort(), "what flying costs");
  Table table({"lice", "stepped", "ns", "ns_best", "sub_steps"});
  for (std::size_t i = 0; i < runners.size(); ++i) {
    const physics::StepCounters counters = runners[i].second.run();
    table.add({runners[i].first->name, runners[i].second.name, times[i].median_ns, times[i].best_ns,
               static_cast<double>(counters.sub_steps) / static_cast<double>(counters.louse_steps)});
  }
  std::cout << "\nA louse-step on hills, scale " << kScale
            << " m, 21 knots, 60 Hz, drag, friction and thrust, " << kLice
            << " lice; sub_steps: of a flight its pieces\n";
  table.print(std::cout);
  return output.write(table, "lab-precision-flight-cost");
}

}  // namespace woodlouse::lab
