#include "server/commands/map_layout.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "shared/map/spawns.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kLooks = 48;  ///< places looked at each way

double slope_at(const terrain::Terrain& ground, core::Vec2 at) {
  const terrain::SurfaceSample s = ground.sample(at.x, at.y);
  return std::sqrt(s.zx * s.zx + s.zy * s.zy);
}

double shorter_side(const terrain::Rectangle& d) { return std::min(d.x_max - d.x_min, d.y_max - d.y_min); }

core::Vec2 middle_of(const terrain::Rectangle& d) {
  return {0.5 * (d.x_min + d.x_max), 0.5 * (d.y_min + d.y_max)};
}

/// Places at equal distances, `margin` [m] inside the edges, by their slope; of equal ones the southern
/// first.
std::vector<LevelPlace> looked_at(const terrain::Terrain& ground, double margin) {
  const terrain::Rectangle& d = ground.domain();
  std::vector<LevelPlace> places;
  for (std::size_t j = 0; j < kLooks; ++j) {
    for (std::size_t i = 0; i < kLooks; ++i) {
      const double u = static_cast<double>(i) / static_cast<double>(kLooks - 1);
      const double v = static_cast<double>(j) / static_cast<double>(kLooks - 1);
      const core::Vec2 at{d.x_min + margin + u * (d.x_max - d.x_min - 2.0 * margin),
                          d.y_min + margin + v * (d.y_max - d.y_min - 2.0 * margin)};
      places.push_back({at, slope_at(ground, at)});
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const LevelPlace& a, const LevelPlace& b) { return a.slope < b.slope; });
  return places;
}

/// Six gates around `middle`, driven through counter-clockwise.
map::RaceMode race_around(core::Vec2 middle, double radius, double half_gate) {
  map::RaceMode race;
  constexpr int kGates = 6;
  for (int k = 0; k < kGates; ++k) {
    const core::Vec2 outwards = map::heading_from_degrees(60.0 * k);
    // From the inner end to the outer one the way on lies at the left.
    race.gates.push_back(
        {middle + (radius - half_gate) * outwards, middle + (radius + half_gate) * outwards, false});
  }
  const core::Vec2 start = middle + core::Vec2{radius, 0.0};
  for (const double aside : {-0.5, 0.0, 0.5})
    race.spawns.push_back(
        {{start.x + aside * half_gate, start.y - std::min(4.0, 0.4 * radius)}, {0.0, 1.0}, 0.0});
  race.laps = 2;
  return race;
}

/// Of all places that have room for a ring of `radius` and `margin` [m] around them, the one with the most
/// level ring: that its steepest place is the flattest.
core::Vec2 middle_of_race(const terrain::Terrain& ground, double radius, double margin) {
  constexpr int kLooksAround = 24;
  core::Vec2 best;
  double best_slope = HUGE_VAL;
  for (const LevelPlace& place : looked_at(ground, radius + margin)) {
    double steepest = 0.0;
    for (int k = 0; k < kLooksAround; ++k)
      steepest = std::fmax(
          steepest,
          slope_at(ground, place.at + radius * map::heading_from_degrees(360.0 / kLooksAround * k)));
    if (!(steepest < best_slope)) continue;
    best_slope = steepest;
    best = place.at;
  }
  return best;
}

}  // namespace

std::vector<LevelPlace> level_places(const terrain::Terrain& ground, std::size_t most) {
  assert(most >= 1);
  const double side = shorter_side(ground.domain());
  std::vector<LevelPlace> chosen;
  for (const LevelPlace& place : looked_at(ground, 0.1 * side)) {
    const bool is_alone = std::all_of(chosen.begin(), chosen.end(), [&](const LevelPlace& other) {
      const core::Vec2 way = place.at - other.at;
      return core::dot(way, way) >= side * side / 36.0;
    });
    if (is_alone) chosen.push_back(place);
    if (chosen.size() == most) break;
  }
  assert(!chosen.empty());
  return chosen;
}

double thrust_for(const terrain::Terrain& ground, const state::Parameters& physics) {
  const std::vector<LevelPlace> places = looked_at(ground, 0.0);
  const double slope = places[places.size() * 4 / 5].slope;
  const double needed = physics.gravity * (slope + physics.friction) / std::sqrt(1.0 + slope * slope);
  return std::round(std::clamp(1.1 * needed, 2.0, 12.0) * 10.0) / 10.0;
}

std::vector<map::SpawnPoint> spawns_for(const terrain::Terrain& ground) {
  const core::Vec2 middle = middle_of(ground.domain());
  std::vector<map::SpawnPoint> spawns;
  for (const LevelPlace& place : level_places(ground, 8)) {
    const core::Vec2 way = middle - place.at;
    const double length = std::sqrt(core::dot(way, way));
    spawns.push_back({place.at, length > 0.0 ? (1.0 / length) * way : core::Vec2{1.0, 0.0}, 0.0});
  }
  return spawns;
}

map::Modes modes_for(const terrain::Terrain& ground) {
  const terrain::Rectangle& d = ground.domain();
  const double side = shorter_side(d);
  map::Modes modes;
  modes.forage = map::ForageMode{};
  modes.hill = map::HillMode{};
  for (const LevelPlace& place : level_places(ground, 3))
    modes.hill->places.push_back(
        {place.at, std::clamp(0.05 * side, 0.1 * side > 3.0 ? 2.0 : 0.05 * side, 5.0)});
  if (side < 20.0) return modes;
  const double radius = std::min(0.3 * side, 60.0);
  const double half_gate = std::min(5.0, 0.4 * radius);
  const core::Vec2 middle = middle_of_race(ground, radius, half_gate + 1.0);
  modes.race = race_around(middle, radius, half_gate);
  return modes;
}

}  // namespace woodlouse::server
