#include "bench/lab/game/stress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bench/lab/game/energy.h"
#include "bench/lab/game/scene.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"
#include "shared/core/random.h"

namespace woodlouse::lab {
namespace {

constexpr std::size_t kLice = 6;
constexpr int kTicks = 240;
constexpr std::size_t kWorst = 10;  // rows of each integrator

enum class Steering { kNone, kBrake, kVectors, kHeadings };
constexpr std::array<const char*, 4> kSteerings = {"none", "brake", "vector each tick", "heading each tick"};

struct Case {
  std::uint64_t seed;
  map::Map map;
  double spacing, slope, rate, speed;
  Steering steering;
  std::vector<state::Louse> lice;
};

double steepest(const terrain::Terrain& ground) {
  const terrain::Rectangle d = ground.domain();
  double most = 0.0;
  for (int i = 0; i <= 60; ++i) {
    for (int j = 0; j <= 60; ++j) {
      const auto s = ground.sample(std::fmin(d.x_min + (d.x_max - d.x_min) * i / 60, d.x_max),
                                   std::fmin(d.y_min + (d.y_max - d.y_min) * j / 60, d.y_max));
      most = std::fmax(most, std::hypot(s.zx, s.zy));
    }
  }
  return most;
}

/// All of it from the seed alone.
Case case_of(std::uint64_t seed) {
  core::Random random(seed * 0x2545F4914F6CDD1Du);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const auto power = [&](double low, double high) { return std::pow(10.0, between(low, high)); };
  Case made{};
  made.seed = seed;
  made.spacing = power(-3.0, 4.0);
  made.slope = std::tan(between(0.0, 60.0) * std::numbers::pi / 180.0);
  made.rate = std::round(power(0.0, 3.0));
  state::Parameters& p = made.map.definition.physics;
  p.gravity = random.uniform() < 0.5 ? 9.81 : power(-1.0, 2.0);
  p.drag = random.uniform() < 0.3 ? 0.0 : power(-2.0, 1.0);
  p.friction = random.uniform() < 0.3 ? 0.0 : power(-2.0, 0.3);
  p.edge_restitution = random.uniform() < 0.3 ? 1.0 : random.uniform();
  p.thrust_max = p.gravity * power(-1.0, 0.5);
  p.contact = random.uniform() < 0.5 ? state::SurfaceContact::kUnilateral : state::SurfaceContact::kBilateral;
  p.edges = random.uniform() < 0.3 ? state::Edges::kWrap : state::Edges::kWalls;
  made.steering = static_cast<Steering>(random.next() % kSteerings.size());

  terrain::HeightGrid grid;
  grid.columns = grid.rows = 6 + random.next() % 10;
  grid.dx = grid.dy = made.spacing;
  for (std::size_t i = 0; i < grid.columns * grid.rows; ++i) grid.heights.push_back(random.uniform());
  const bool wraps = p.edges == state::Edges::kWrap;
  for (std::size_t i = 0; wraps && i < grid.columns; ++i) {
    grid.heights[(grid.rows - 1) * grid.columns + i] = grid.heights[i];
    grid.heights[i * grid.columns + grid.columns - 1] = grid.heights[i * grid.columns];
  }
  if (wraps) grid.heights.back() = grid.heights.front();
  const auto ends = wraps ? terrain::SplineEnds::kPeriodic : terrain::SplineEnds::kNotAKnot;
  const double raw = steepest(terrain::Terrain(terrain::BicubicSpline(grid, ends)));
  for (double& height : grid.heights) height *= made.slope / raw;
  made.map.terrain = std::make_shared<const terrain::Terrain>(terrain::BicubicSpline(grid, ends));
  made.map.definition.name = "seed " + std::to_string(seed);

  // As fast as who falls down a slope, or ten times that.
  made.speed = std::sqrt(p.gravity * made.spacing * std::fmax(made.slope, 0.1)) * power(-1.0, 1.0);
  made.lice = starting_lice(made.map, kLice, seed);
  for (state::Louse& louse : made.lice) louse.velocity = (made.speed / 3.0) * louse.velocity;
  return made;
}

struct Outcome {
  double gained = 0.0, capped = 0.0, not_finite = 0.0, outside = 0.0;
};

Outcome run(const Case& made, Integrator integrator) {
  const auto rate = static_cast<int>(made.rate);
  const auto world = world_of(made.map, integrator, rate);
  world->restore(made.lice);
  if (made.steering == Steering::kBrake) {
    for (const state::Louse& louse : made.lice)
      world->set_thrust(louse.id, {state::ThrustKind::kAlongHeading, {-0.5, 0.0}}, state::kHeld);
  }
  EnergyWatch watch(*world, false);
  for (std::uint64_t tick = 0; tick < kTicks && watch.not_finite() == 0; ++tick) {
    if (made.steering == Steering::kVectors || made.steering == Steering::kHeadings) {
      play_on(*world, made.steering == Steering::kVectors ? Play::kVectorEachTick : Play::kHeadingEachTick,
              rate, tick, 1);
    } else {
      world->step();
    }
    watch.look();
  }
  const auto& c = world->counters();
  return {watch.gained(),
          static_cast<double>(c.capped) / static_cast<double>(std::max<std::uint64_t>(1, c.sub_steps)),
          static_cast<double>(watch.not_finite()), static_cast<double>(watch.outside())};
}

/// What docs/physics.md states of a rooms' method; of the others nothing is.
double stated(Integrator integrator) {
  if (!room_method(integrator)) return std::numeric_limits<double>::infinity();
  return integrator == Integrator::kVerletQ ? 1e-2 : 1e-3;
}

}  // namespace

core::Expected<void> measure_stress(std::size_t count, std::uint64_t seed, const Output& output) {
  Table table({"integrator", "gained", "seed", "spacing", "slope", "rate", "gravity", "friction", "contact",
               "edges", "steering", "speed", "capped", "not_finite", "outside"});
  Table summary({"integrator", "maps", "gained_median", "gained_99_of_100", "gained_worst", "its_seed",
                 "beyond_stated", "not_finite", "outside"});
  std::array<std::vector<std::pair<Outcome, std::uint64_t>>, kIntegrators.size()> all;
  for (auto& outcomes : all) outcomes.resize(count);
  {
    Progress progress("maps made by chance", count);
    side_by_side(
        count,
        [&](std::size_t i) {
          const Case made = case_of(seed + i);
          for (std::size_t m = 0; m < kIntegrators.size(); ++m)
            all[m][i] = {run(made, kIntegrators[m]), made.seed};
        },
        [&] { progress.advance(); });
  }
  double broken = 0.0;
  for (std::size_t m = 0; m < kIntegrators.size(); ++m) {
    auto& outcomes = all[m];
    std::sort(outcomes.begin(), outcomes.end(),
              [](const auto& a, const auto& b) { return a.first.gained > b.first.gained; });
    double beyond = 0.0, not_finite = 0.0, outside = 0.0;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const auto& [outcome, its_seed] = outcomes[i];
      const bool breaks = outcome.gained > stated(kIntegrators[m]);
      beyond += breaks ? 1.0 : 0.0;
      not_finite += outcome.not_finite > 0.0 ? 1.0 : 0.0;
      outside += outcome.outside > 0.0 ? 1.0 : 0.0;
      if (i >= kWorst && !(room_method(kIntegrators[m]) && (breaks || outcome.outside > 0.0))) continue;
      const Case made = case_of(its_seed);
      const state::Parameters& p = made.map.definition.physics;
      table.add({std::string(to_text(kIntegrators[m])), outcome.gained, static_cast<double>(its_seed),
                 made.spacing, made.slope, made.rate, p.gravity, p.friction,
                 std::string(state::to_text(p.contact)), std::string(state::to_text(p.edges)),
                 std::string(kSteerings[static_cast<std::size_t>(made.steering)]), made.speed, outcome.capped,
                 outcome.not_finite, outcome.outside});
    }
    const auto share = [&](double from_worst) {
      return outcomes[static_cast<std::size_t>(from_worst * static_cast<double>(outcomes.size() - 1))]
          .first.gained;
    };
    if (room_method(kIntegrators[m])) broken += beyond + not_finite + outside;
    summary.add({std::string(to_text(kIntegrators[m])), static_cast<double>(outcomes.size()), share(0.5),
                 share(0.01), share(0.0), static_cast<double>(outcomes.front().second), beyond, not_finite,
                 outside});
  }
  std::cout << "\nMaps made by chance, " << kTicks << " ticks of " << kLice
            << " lice: energy that nobody gave; `--only random --random 1 --seed S` makes one again\n";
  summary.print(std::cout);
  if (broken > 0.0) std::cout << "Beyond what is stated of the rooms' methods: " << broken << '\n';
  return output.write(table, "lab-stability-random");
}

}  // namespace woodlouse::lab
