#include "shared/map/spawns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "shared/core/joined.h"
#include "shared/core/portable_trigonometry.h"
#include "shared/json/text.h"

namespace woodlouse::map {
namespace {

constexpr json::Range kSpawnSpeed{0.0, 1000.0, "m/s"};
constexpr json::Range kDegrees{-360.0, 360.0, "degrees"};
constexpr json::Range kSpawnCoordinate{-1e12, 1e12, "m"};
constexpr json::Range kHeadingComponent{-1e6, 1e6, ""};
constexpr std::size_t kMaxSpawns = 1024;
/// A pair this near to length 1 is taken as it stands, so that a written unit vector reads back bit for bit.
constexpr double kUnitTolerance = 1e-14;

core::Vec2 read_heading(const json::Value& value, json::Problems& problems) {
  if (value.is_number()) {
    const std::optional<double> degrees = json::number_in(value, kDegrees, problems);
    return degrees ? heading_from_degrees(*degrees) : core::Vec2{1.0, 0.0};
  }
  if (!value.is(json::Kind::kArray)) {
    problems.add(value, "degrees or a pair [x, y] are wanted", "degrees run counter-clockwise, 0 is east");
    return {1.0, 0.0};
  }
  const core::Vec2 pair = json::pair_in(value, kHeadingComponent, problems).value_or(core::Vec2{1.0, 0.0});
  const double square = core::dot(pair, pair);
  if (std::abs(square - 1.0) <= kUnitTolerance) return pair;
  if (square < 1e-12) {
    problems.add(value, "a heading of length 0 points nowhere");
    return {1.0, 0.0};
  }
  const double length = std::sqrt(square);
  return {pair.x / length, pair.y / length};
}

}  // namespace

state::Louse louse_at(const SpawnPoint& spawn, state::LouseId id) {
  state::Louse louse;
  louse.id = id;
  louse.position = spawn.position;
  louse.heading = spawn.heading;
  louse.velocity = spawn.speed * spawn.heading;
  return louse;
}

core::Vec2 heading_from_degrees(double degrees) {
  // The quadrant is taken off in degrees, where it is exact.
  const double turns = degrees / 90.0;
  const auto quadrant = static_cast<long long>(turns + (turns >= 0.0 ? 0.5 : -0.5));
  constexpr double kRadians = 0.017453292519943295769;
  const auto [s, c] = core::portable_sincos((degrees - 90.0 * static_cast<double>(quadrant)) * kRadians);
  // "+ 0.0" turns -0.0 into 0.0.
  switch (quadrant & 3) {
    case 0:
      return {c + 0.0, s + 0.0};
    case 1:
      return {-s + 0.0, c + 0.0};
    case 2:
      return {-c + 0.0, -s + 0.0};
    default:
      return {s + 0.0, -c + 0.0};
  }
}

std::vector<SpawnPoint> default_spawns(const terrain::Rectangle& domain) {
  constexpr int kCount = 8;
  constexpr double kShare = 0.6;  // of the way from the middle to the nearer walls
  const core::Vec2 middle{0.5 * (domain.x_min + domain.x_max), 0.5 * (domain.y_min + domain.y_max)};
  const double radius = kShare * 0.5 * std::min(domain.x_max - domain.x_min, domain.y_max - domain.y_min);
  std::vector<SpawnPoint> result;
  for (int k = 0; k < kCount; ++k) {
    const core::Vec2 outward = heading_from_degrees(k * 360.0 / kCount);
    result.push_back({middle + radius * outward, {0.0 - outward.x, 0.0 - outward.y}});
  }
  return result;
}

std::vector<SpawnPoint> read_spawns(const json::Value& value, const terrain::Rectangle& domain,
                                    json::Problems& problems) {
  std::vector<SpawnPoint> result;
  const std::vector<json::Value> points = value.children();
  if (!value.is(json::Kind::kArray) || points.empty() || points.size() > kMaxSpawns) {
    problems.add(value, "a list of 1 to 1024 spawn points is wanted", "leave it out for a ring of eight");
    return result;
  }
  for (const json::Value& point : points) {
    const json::Fields fields(point, {"position", "heading", "speed"}, problems);
    SpawnPoint spawn;
    if (const auto position = fields.demand("position", "[x, y] in metres")) {
      spawn.position = json::pair_in(*position, kSpawnCoordinate, problems)
                           .value_or(core::Vec2{domain.x_min, domain.y_min});
      if (!domain.contains(spawn.position.x, spawn.position.y)) {
        problems.add(*position, "lies outside the map",
                     core::joined({"x ", json::double_text(domain.x_min), " to ",
                                   json::double_text(domain.x_max), " m, y ", json::double_text(domain.y_min),
                                   " to ", json::double_text(domain.y_max), " m"}));
      }
    }
    if (const auto heading = fields.find("heading")) spawn.heading = read_heading(*heading, problems);
    spawn.speed = fields.number_or("speed", kSpawnSpeed, spawn.speed) + 0.0;  // as central_gravity
    result.push_back(spawn);
  }
  return result;
}

void add_spawns(json::ObjectText& text, const std::vector<SpawnPoint>& spawns) {
  text.objects("spawns", spawns, [](json::ObjectText& entry, const SpawnPoint& spawn) {
    entry.pair("position", spawn.position).pair("heading", spawn.heading);
    if (spawn.speed != 0.0) entry.number("speed", spawn.speed);
  });
}

}  // namespace woodlouse::map
