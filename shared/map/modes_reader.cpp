#include "shared/map/modes_reader.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/map/spawns.h"

namespace woodlouse::map {
namespace {

using core::Vec2;
using json::Fields;
using json::Problems;

constexpr json::Range kPlaceCoordinate{-1e12, 1e12, "m"};
constexpr json::Range kCrumbRadius{0.1, 100.0, "m"};
constexpr json::Range kPlaceRadius{0.1, 1000.0, "m"};
constexpr json::Range kBumpRadius{0.0, 100.0, "m"};
constexpr json::Range kBumpRestitution{0.0, 1.0, ""};
constexpr std::uint64_t kMaxLaps = 100;
constexpr std::uint64_t kMaxSeconds = 86400;
constexpr std::uint64_t kMaxAuthorMs = 86'400'000;
constexpr double kShortestGate = 1.5, kGateMargin = 0.5;      // [m]
constexpr double kNearestSpawn = 1.0, kFarthestSpawn = 15.0;  // before the first gate [m]

/// A whole number that may be left out.
template <typename T>
void read_integer(const Fields& fields, std::string_view key, std::uint64_t low, std::uint64_t high, T& out,
                  Problems& problems) {
  if (const auto value = fields.find(key))
    out = static_cast<T>(json::integer_in(*value, low, high, problems).value_or(out));
}

bool is_within(const terrain::Rectangle& domain, Vec2 p, double margin) {
  return p.x >= domain.x_min + margin && p.x <= domain.x_max - margin && p.y >= domain.y_min + margin &&
         p.y <= domain.y_max - margin;
}

// ---- race ------------------------------------------------------------------------------------------------

/// [m]
double length(Vec2 v) { return std::sqrt(core::dot(v, v)); }

Gate read_gate(const json::Value& value, const terrain::Rectangle& domain, Problems& problems) {
  const Fields fields(value, {"a", "b", "air"}, problems);
  Gate gate;
  for (auto [key, place] : {std::pair("a", &gate.a), std::pair("b", &gate.b)}) {
    const auto end = fields.demand(key, "[x, y] in metres");
    if (!end) continue;
    const std::optional<Vec2> pair = json::pair_in(*end, kPlaceCoordinate, problems);
    if (!pair) continue;
    *place = *pair;
    if (!is_within(domain, *pair, kGateMargin))
      problems.add(*end, core::joined({"is not ", json::double_text(kGateMargin), " m within the map"}));
  }
  if (const auto air = fields.find("air")) {
    if (!air->is(json::Kind::kBoolean)) {
      problems.add(*air, "true or false is wanted");
    } else {
      gate.in_air = air->boolean();
    }
  }
  if (length(gate.b - gate.a) < kShortestGate)
    problems.add(value, core::joined({"is shorter than ", json::double_text(kShortestGate), " m"}));
  return gate;
}

/// Whether they have a point in common.
bool cross(const Gate& one, const Gate& other) {
  const auto side = [](const Gate& gate, Vec2 p) { return core::cross(gate.b - gate.a, p - gate.a); };
  const auto parts = [&](const Gate& gate, const Gate& by) {
    const double a = side(by, gate.a), b = side(by, gate.b);
    return !(a > 0.0 && b > 0.0) && !(a < 0.0 && b < 0.0);
  };
  // On one line each parts the other, however far apart they are.
  const auto overlap = [](double a, double b, double c, double d) {
    return std::max(a, b) >= std::min(c, d) && std::max(c, d) >= std::min(a, b);
  };
  return parts(one, other) && parts(other, one) && overlap(one.a.x, one.b.x, other.a.x, other.b.x) &&
         overlap(one.a.y, one.b.y, other.a.y, other.b.y);
}

std::vector<Gate> read_gates(const json::Value& value, const terrain::Rectangle& domain, Problems& problems) {
  const std::vector<json::Value> children = value.children();
  if (!value.is(json::Kind::kArray) || children.size() < kMinGates || children.size() > kMaxGates) {
    problems.add(value, "a list of 2 to 32 gates is wanted", "{\"a\": [x, y], \"b\": [x, y]}");
    return {};
  }
  std::vector<Gate> gates;
  for (const json::Value& child : children) {
    const Gate gate = read_gate(child, domain, problems);
    for (std::size_t k = 0; k < gates.size(); ++k) {
      if (cross(gates[k], gate))
        problems.add(child, core::joined({"crosses gate ", std::to_string(k), " (they count from 0)"}));
    }
    gates.push_back(gate);
  }
  return gates;
}

void check_spawn(const json::Value& value, std::size_t number, const SpawnPoint& spawn, const Gate& first,
                 Problems& problems) {
  const std::string name = core::joined({"spawn ", std::to_string(number), " "});
  if (spawn.speed != 0.0) problems.add(value, core::joined({name, "moves: a race begins at rest"}));
  const Vec2 along = first.b - first.a;
  const double before = 0.0 - core::cross(along, spawn.position - first.a) / length(along);
  if (before >= kNearestSpawn && before <= kFarthestSpawn) return;
  problems.add(value, core::joined({name, "lies ", json::double_text(before), " m before the first gate"}),
               "1 to 15 m are wanted; a gate is driven through from its right-hand side, seen from a to b");
}

RaceMode read_race(const json::Value& value, const MapDefinition& definition,
                   const terrain::Rectangle& domain, Problems& problems) {
  const Fields fields(value, {"laps", "gates", "round_s", "podium_s", "author_ms", "spawns"}, problems);
  RaceMode race;
  read_integer(fields, "laps", 1, kMaxLaps, race.laps, problems);
  read_integer(fields, "round_s", 1, kMaxSeconds, race.round_s, problems);
  read_integer(fields, "podium_s", 1, kMaxSeconds, race.podium_s, problems);
  read_integer(fields, "author_ms", 0, kMaxAuthorMs, race.author_ms, problems);
  if (const auto gates = fields.demand("gates")) race.gates = read_gates(*gates, domain, problems);
  const auto spawns = fields.find("spawns");
  if (spawns) race.spawns = read_spawns(*spawns, domain, problems);
  if (race.gates.empty() || length(race.gates[0].b - race.gates[0].a) == 0.0) return race;
  const std::vector<SpawnPoint>& used = spawns ? race.spawns : definition.spawns;
  for (std::size_t k = 0; k < used.size(); ++k)
    check_spawn(spawns.value_or(value), k, used[k], race.gates[0], problems);
  return race;
}

void add_race(json::ObjectText& text, const RaceMode& race) {
  text.integer("laps", race.laps);
  text.objects("gates", race.gates, [](json::ObjectText& entry, const Gate& gate) {
    entry.pair("a", gate.a).pair("b", gate.b);
    if (gate.in_air) entry.boolean("air", true);
  });
  text.integer("round_s", race.round_s).integer("podium_s", race.podium_s);
  if (!race.spawns.empty()) add_spawns(text, race.spawns);
}

// ---- forage ----------------------------------------------------------------------------------------------

ForageMode read_forage(const json::Value& value, const MapDefinition& definition, Problems& problems) {
  const Fields fields(value, {"crumbs", "radius", "round_s", "podium_s", "summits"}, problems);
  ForageMode forage;
  read_integer(fields, "crumbs", 1, kMaxCrumbs, forage.crumbs, problems);
  forage.radius = fields.number_or("radius", kCrumbRadius, forage.radius);
  read_integer(fields, "round_s", 1, kMaxSeconds, forage.round_s, problems);
  read_integer(fields, "podium_s", 1, kMaxSeconds, forage.podium_s, problems);
  forage.summits = std::min(forage.summits, forage.crumbs);
  read_integer(fields, "summits", 0, forage.crumbs, forage.summits, problems);
  if (!(definition.physics.gravity > 0.0))
    problems.add(value, "there is no gravity: no place is harder to reach than another", "leave forage out");
  return forage;
}

void add_forage(json::ObjectText& text, const ForageMode& forage) {
  text.integer("crumbs", forage.crumbs).number("radius", forage.radius);
  text.integer("round_s", forage.round_s).integer("podium_s", forage.podium_s);
  text.integer("summits", forage.summits);
}

// ---- hill ------------------------------------------------------------------------------------------------

std::vector<HillPlace> read_places(const json::Value& value, const terrain::Rectangle& domain,
                                   Problems& problems) {
  const std::vector<json::Value> children = value.children();
  if (!value.is(json::Kind::kArray) || children.empty() || children.size() > kMaxPlaces) {
    problems.add(value, "a list of 1 to 16 places is wanted", "{\"at\": [x, y], \"radius\": 3}");
    return {};
  }
  std::vector<HillPlace> places;
  for (const json::Value& child : children) {
    const Fields fields(child, {"at", "radius"}, problems);
    HillPlace place;
    place.radius = fields.number_or("radius", kPlaceRadius, place.radius);
    if (const auto at = fields.demand("at", "[x, y] in metres")) {
      place.at = json::pair_in(*at, kPlaceCoordinate, problems).value_or(Vec2{domain.x_min, domain.y_min});
      if (!is_within(domain, place.at, place.radius))
        problems.add(*at, "is not on the map with all of its radius");
    }
    places.push_back(place);
  }
  return places;
}

HillMode read_hill(const json::Value& value, const MapDefinition& definition,
                   const terrain::Rectangle& domain, Problems& problems) {
  const Fields fields(value, {"places", "hold_s", "move_s", "bump", "edge", "out_s", "podium_s"}, problems);
  HillMode hill;
  if (const auto places = fields.demand("places")) hill.places = read_places(*places, domain, problems);
  read_integer(fields, "hold_s", 1, kMaxSeconds, hill.hold_s, problems);
  read_integer(fields, "move_s", 1, kMaxSeconds, hill.move_s, problems);
  read_integer(fields, "out_s", 1, kMaxSeconds, hill.out_s, problems);
  read_integer(fields, "podium_s", 1, kMaxSeconds, hill.podium_s, problems);
  if (const auto bump = fields.find("bump")) {
    const Fields bumps(*bump, {"radius", "restitution"}, problems);
    // "+ 0.0": -0.0 would read back as another text.
    hill.bump_radius = bumps.number_or("radius", kBumpRadius, hill.bump_radius) + 0.0;
    hill.bump_restitution = bumps.number_or("restitution", kBumpRestitution, hill.bump_restitution) + 0.0;
  }
  if (const auto edge = fields.find("edge")) {
    hill.falls = edge->is(json::Kind::kString) && edge->text() == "fall";
    if (!hill.falls && !(edge->is(json::Kind::kString) && edge->text() == "walls"))
      problems.add(*edge, "is none of its choices", "fall or walls");
    if (hill.falls && definition.physics.edges == state::Edges::kWrap)
      problems.add(*edge, "the map's edges wrap: there is nothing to fall over", "leave it out");
  }
  return hill;
}

void add_hill(json::ObjectText& text, const HillMode& hill) {
  text.objects("places", hill.places, [](json::ObjectText& entry, const HillPlace& place) {
    entry.pair("at", place.at).number("radius", place.radius);
  });
  text.integer("hold_s", hill.hold_s).integer("move_s", hill.move_s);
  text.object("bump", [&](json::ObjectText& bump) {
    bump.number("radius", hill.bump_radius).number("restitution", hill.bump_restitution);
  });
  if (hill.falls) text.text("edge", "fall");
  text.integer("out_s", hill.out_s).integer("podium_s", hill.podium_s);
}

}  // namespace

Modes read_modes(const json::Value& root, const MapDefinition& definition, const terrain::Rectangle& domain,
                 Problems& problems) {
  Modes modes;
  if (const auto value = root.find("race")) modes.race = read_race(*value, definition, domain, problems);
  if (const auto value = root.find("forage")) modes.forage = read_forage(*value, definition, problems);
  if (const auto value = root.find("hill")) modes.hill = read_hill(*value, definition, domain, problems);
  return modes;
}

void add_modes(json::ObjectText& map, const Modes& modes) {
  if (modes.race) map.object("race", [&](json::ObjectText& text) { add_race(text, *modes.race); });
  if (modes.forage) map.object("forage", [&](json::ObjectText& text) { add_forage(text, *modes.forage); });
  if (modes.hill) map.object("hill", [&](json::ObjectText& text) { add_hill(text, *modes.hill); });
}

std::string mode_text(const Modes& modes, state::Mode mode) {
  assert(modes.has(mode));
  std::string out;
  json::ObjectText text(out);
  if (mode == state::Mode::kRace) {
    add_race(text, *modes.race);
    if (modes.race->author_ms != 0) text.integer("author_ms", modes.race->author_ms);
  }
  if (mode == state::Mode::kForage) add_forage(text, *modes.forage);
  if (mode == state::Mode::kHill) add_hill(text, *modes.hill);
  text.end();
  return out;
}

}  // namespace woodlouse::map
