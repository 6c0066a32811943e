#include "server/commands/map_summary.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <variant>

#include "shared/core/random.h"
#include "shared/map/canonical_map.h"
#include "shared/map/map_world.h"
#include "shared/map/spawns.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kMostCells = 512;  ///< each way that are looked at; of more knots equally spaced ones
constexpr std::size_t kLice = 64;
constexpr int kTicks = 300;
constexpr double kTickHz = 60.0;

struct Shape {
  double low = 1e300, high = -1e300;  ///< [m]
  double slope = 0.0;                 ///< steepest
  double curvature = 0.0;             ///< largest normal curvature [1/m]
  double overshoot = 0.0;             ///< [m]
};

/// The larger of the principal curvatures' bounds: the Hessian's eigenvalue over sqrt(1 + slope^2).
double curvature_of(const terrain::SurfaceSample& s) {
  const double mean = 0.5 * (s.zxx + s.zyy);
  const double half = 0.5 * (s.zxx - s.zyy);
  const double eigenvalue = std::fabs(mean) + std::sqrt(half * half + s.zxy * s.zxy);
  return eigenvalue / std::sqrt(1.0 + s.zx * s.zx + s.zy * s.zy);
}

/// Looks at the corner and the middle of each of columns x rows cells. Overshoot: by how much the middle of a
/// cell lies above all its corners, or below them.
Shape shape_of(const terrain::Terrain& ground, std::size_t columns, std::size_t rows) {
  const terrain::Rectangle& d = ground.domain();
  const double dx = (d.x_max - d.x_min) / static_cast<double>(columns);
  const double dy = (d.y_max - d.y_min) / static_cast<double>(rows);
  const auto at = [&](double i, double j) {
    return ground.sample(std::clamp(d.x_min + i * dx, d.x_min, d.x_max),
                         std::clamp(d.y_min + j * dy, d.y_min, d.y_max));
  };
  Shape shape;
  const auto look = [&shape](const terrain::SurfaceSample& s) {
    shape.low = std::fmin(shape.low, s.z);
    shape.high = std::fmax(shape.high, s.z);
    shape.slope = std::fmax(shape.slope, std::sqrt(s.zx * s.zx + s.zy * s.zy));
    shape.curvature = std::fmax(shape.curvature, curvature_of(s));
    return s.z;
  };
  std::vector<double> south(columns + 1);
  for (std::size_t i = 0; i <= columns; ++i) south[i] = look(at(static_cast<double>(i), 0.0));
  for (std::size_t j = 0; j < rows; ++j) {
    std::vector<double> north(columns + 1);
    for (std::size_t i = 0; i <= columns; ++i)
      north[i] = look(at(static_cast<double>(i), static_cast<double>(j + 1)));
    for (std::size_t i = 0; i < columns; ++i) {
      const double middle = look(at(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5));
      const auto [low, high] = std::minmax({south[i], south[i + 1], north[i], north[i + 1]});
      shape.overshoot = std::max({shape.overshoot, middle - high, low - middle});
    }
    south.swap(north);
  }
  return shape;
}

struct Cost {
  double sub_steps = 0.0;    ///< a louse's step
  double nanoseconds = 0.0;  ///< of it, here and now
  double capped = 0.0;       ///< share of sub-steps that wanted to be shorter
};

/// Lice from the spawns that hold full thrust into directions drawn anew each second.
Cost cost_of(const map::Map& map) {
  physics::World world = map::make_world(map, 1.0 / kTickHz);
  core::Random random(1);
  for (std::size_t k = 0; k < kLice; ++k) {
    const auto& spawns = map.definition.spawns;
    world.insert(map::louse_at(spawns[k % spawns.size()], static_cast<state::LouseId>(k + 1)));
  }
  const auto begin = std::chrono::steady_clock::now();
  for (int tick = 0; tick < kTicks; ++tick) {
    for (std::size_t k = 0; tick % 60 == 0 && k < kLice; ++k) {
      const core::Vec2 push = map::heading_from_degrees(360.0 * random.uniform());
      world.set_thrust(static_cast<state::LouseId>(k + 1), {state::ThrustKind::kMapVector, push}, 60);
    }
    world.step();
  }
  const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
  const physics::StepCounters& counters = world.counters();
  const auto steps = static_cast<double>(std::max<std::uint64_t>(counters.louse_steps, 1));
  return {static_cast<double>(counters.sub_steps) / steps, took.count() / steps,
          static_cast<double>(counters.capped) /
              static_cast<double>(std::max<std::uint64_t>(counters.sub_steps, 1))};
}

}  // namespace

std::vector<std::string> summary_of(const map::Map& map) {
  const auto* tiled = std::get_if<map::TiledTerrain>(&map.definition.terrain);
  std::size_t columns = 0, rows = 0;
  if (tiled != nullptr) {
    columns = tiled->heights->frame().columns;
    rows = tiled->heights->frame().rows;
  } else {
    const terrain::HeightGrid knots = map::knots_of(map.definition);
    columns = knots.columns;
    rows = knots.rows;
  }
  const terrain::Rectangle& d = map.terrain->domain();
  // A look at every tile of a country would read all of it: its overview has one knot for many.
  const Shape shape = tiled != nullptr ? shape_of(terrain::Terrain(terrain::BicubicSpline(tiled->overview)),
                                                  tiled->overview.columns - 1, tiled->overview.rows - 1)
                                       : shape_of(*map.terrain, std::min(columns - 1, kMostCells),
                                                  std::min(rows - 1, kMostCells));
  const Cost cost = cost_of(map);
  std::vector<std::string> lines;
  lines.push_back(fmt::format("size: {:.6g} m by {:.6g} m, {} by {} knots", d.x_max - d.x_min,
                              d.y_max - d.y_min, columns, rows));
  const char* of = tiled != nullptr ? " (of the overview)" : "";
  lines.push_back(fmt::format("relief: {:.6g} m, from {:.6g} to {:.6g} m{}", shape.high - shape.low,
                              shape.low, shape.high, of));
  lines.push_back(fmt::format("steepest slope: {:.3g} m a metre{}", shape.slope, of));
  // The surfaces of the paper are known by their slopes alone.
  if (!map::is_of_document(map.definition.surface))
    lines.push_back(shape.curvature > 0.0
                        ? fmt::format("largest curvature: {:.3g} 1/m, a radius of {:.3g} m{}",
                                      shape.curvature, 1.0 / shape.curvature, of)
                        : std::string("largest curvature: none"));
  lines.push_back(
      fmt::format("overshoot: at most {:.3g} m beyond the corners of a cell{}", shape.overshoot, of));
  lines.push_back(fmt::format("a louse's step: {:.2f} sub-steps, {:.1f} % of them capped, {:.0f} ns here",
                              cost.sub_steps, 100.0 * cost.capped, cost.nanoseconds));
  return lines;
}

}  // namespace woodlouse::server
