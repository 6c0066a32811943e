#include "bench/lab/soak.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/speed/maps.h"
#include "shared/core/random.h"
#include "shared/map/map_world.h"
#include "shared/physics/world.h"

namespace woodlouse::lab {
namespace {

constexpr std::uint32_t kLice = 1000;
constexpr double kScale = 20.0;

/// The most energy a louse can have, from the bottom, is what thrust can give against drag over the longest
/// way; a speed far beyond it is energy from nothing.
constexpr double kAbsurdSpeed = 1000.0;

struct Findings {
  double not_finite = 0.0, outside = 0.0, absurd = 0.0, fastest = 0.0;
};

void look(const physics::World& world, Findings& findings) {
  const terrain::Rectangle domain = world.terrain().domain();
  for (const state::Louse& louse : world.lice()) {
    const double speed = std::hypot(louse.velocity.x, louse.velocity.y);
    if (!std::isfinite(speed) || !std::isfinite(louse.position.x) || !std::isfinite(louse.position.y)) {
      ++findings.not_finite;
      continue;
    }
    if (!domain.contains(louse.position.x, louse.position.y)) ++findings.outside;
    if (speed > kAbsurdSpeed) ++findings.absurd;
    findings.fastest = std::fmax(findings.fastest, speed);
  }
}

/// A thousand lice of a world are pushed about until it has made `wanted` louse-steps; a row of the table.
void soak_one(physics::World& world, const std::string& name, std::uint64_t wanted, Table& table) {
  core::Random random(11);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  const terrain::Rectangle domain = world.terrain().domain();
  const auto within = [&](double low, double high) {
    return 0.5 * (low + high) + symmetric(0.5 * (high - low));
  };
  for (std::uint32_t id = 1; id <= kLice; ++id) {
    state::Louse louse = louse_at({within(domain.x_min, domain.x_max), within(domain.y_min, domain.y_max)},
                                  {symmetric(10), symmetric(10)});
    louse.id = id;
    world.insert(louse);
  }
  Findings findings;
  Progress progress("soak on " + name, wanted);
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t tick = 0; world.counters().louse_steps < wanted; ++tick) {
    // Most change their thrust once a second, every eighth with each tick; vectors, headings, brakes.
    for (std::uint32_t id = 1; id <= kLice; ++id) {
      if (tick % 60 != 0 && id % 8 != 0) continue;
      const double angle = symmetric(std::numbers::pi);
      const state::Thrust vector{state::ThrustKind::kMapVector, {std::cos(angle), std::sin(angle)}};
      const state::Thrust along{state::ThrustKind::kAlongHeading, {symmetric(1.0), 0.0}};
      world.set_thrust(id, id % 2 == 0 ? vector : along, state::kHeld);
    }
    const std::uint64_t before = world.counters().louse_steps;
    world.step();
    progress.advance(world.counters().louse_steps - before);
    if (tick % 10 == 0) look(world, findings);
  }
  const double ns =
      std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
  look(world, findings);
  const auto& c = world.counters();
  const auto number = [](std::uint64_t n) { return static_cast<double>(n); };
  table.add({name, number(c.louse_steps), number(c.sub_steps), number(c.bounces), number(c.flights),
             number(c.stops), number(c.capped), findings.not_finite, findings.outside, findings.absurd,
             findings.fastest, ns / number(c.louse_steps)});
}

}  // namespace

core::Expected<Table> soak(const std::filesystem::path& folder, Effort effort) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  Table table({"terrain", "louse_steps", "sub_steps", "bounces", "flights", "stops", "capped", "not_finite",
               "outside", "absurd", "fastest", "ns_per_step"});
  const std::uint64_t wanted = effort == Effort::kQuick ? 200'000 : 10'000'000;
  for (const auto function : terrain::kFunctionNames) {
    const auto ground = std::make_shared<const terrain::Terrain>(
        terrain::BicubicSpline(terrain::sample_function(function, kScale, 50)));
    physics::World world(ground, {9.81, 0.2, 0.05, 6.0, 0.5}, 1.0 / 60.0);
    soak_one(world, std::string(to_text(function)), wanted, table);
  }
  for (const auto& map : *maps) {
    physics::World world = map::make_world(*map, 1.0 / 60.0);
    soak_one(world, "map " + map->definition.name, wanted, table);
  }
  return table;
}

}  // namespace woodlouse::lab
