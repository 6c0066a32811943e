#include "server/records/course.h"

#include <cassert>
#include <filesystem>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/json/object_text.h"
#include "shared/map/canonical_map.h"
#include "shared/match/match.h"

namespace woodlouse::server {
namespace {

constexpr std::string_view kFormat = "woodlouse-records";
constexpr std::uint64_t kVersion = 1;
constexpr std::size_t kMaxTextBytes = 4096;

}  // namespace

std::uint64_t course_key(const map::Map& map, std::uint32_t tick_hz, int behavior) {
  assert(map.definition.modes.race);
  map::MapDefinition course = map.definition;
  course.name = "course";
  map::RaceMode race = std::move(*course.modes.race);
  if (!race.spawns.empty()) course.spawns = std::exchange(race.spawns, {});
  race.round_s = map::RaceMode().round_s;
  race.podium_s = map::RaceMode().podium_s;
  course.modes = {};
  course.modes.race = std::move(race);
  return core::stable_hash(core::joined(
      {map::canonical_text(course), "\n", std::to_string(tick_hz), " ", std::to_string(behavior)}));
}

bool BoardHeader::can_be_re_run() const { return behavior == match::kBehavior; }

BoardHeader header_of(const map::Map& map, std::uint32_t tick_hz, const std::string& map_file) {
  BoardHeader header;
  header.behavior = match::kBehavior;
  header.tick_hz = tick_hz;
  header.key = course_key(map, tick_hz, match::kBehavior);
  header.map_name = map.definition.name;
  const bool fits = map.canonical.size() <= kMaxBoardMapBytes &&
                    !std::holds_alternative<map::TiledTerrain>(map.definition.terrain);
  if (fits)
    header.definition = map.canonical;
  else
    header.map_file = std::filesystem::path(map_file).filename().string();
  return header;
}

std::string header_line(const BoardHeader& header) {
  std::string out;
  json::ObjectText text(out);
  text.text("format", kFormat).integer("version", kVersion).integer("behavior", header.behavior);
  text.integer("tick_hz", header.tick_hz).hash("key", header.key);
  text.object("map", [&](json::ObjectText& map) {
    map.text("name", header.map_name);
    if (header.definition.empty())
      map.text("file", header.map_file);
    else
      map.json("definition", header.definition);
  });
  text.end_line();
  return out;
}

/// What a later version adds is passed over; what it changes has another version.
core::Expected<BoardHeader> read_header_line(std::string_view line, std::string_view name) {
  const auto document = json::parse_file(line, name, {16, 20'000'000});
  if (!document) return tl::unexpected(document.error());
  const json::Value root = document->root();
  const auto format = root.find("format");
  if (!format || !format->is(json::Kind::kString) || format->text() != kFormat)
    return core::fail(std::string(name), "is no board of records");
  const auto version = root.find("version");
  if (!version || version->unsigned_integer() != kVersion)
    return core::fail(std::string(name), "is a board of another version",
                      core::joined({"this program reads version ", std::to_string(kVersion)}));
  json::Problems problems{std::string(name)};
  const json::Fields fields(root, {"format", "version", "behavior", "tick_hz", "key", "map"}, problems);
  BoardHeader header;
  header.behavior = static_cast<int>(fields.integer("behavior", 0, 0x7fff'ffff));
  header.tick_hz = static_cast<std::uint32_t>(fields.integer("tick_hz", 1, 1000));
  header.key = fields.hash("key");
  if (const auto map = fields.demand("map")) {
    const json::Fields of_map(*map, {"name", "definition", "file"}, problems);
    header.map_name = of_map.text("name", kMaxTextBytes);
    const auto definition = of_map.find("definition");
    if (definition && definition->is(json::Kind::kObject))
      header.definition = definition->raw();
    else
      header.map_file = of_map.text("file", kMaxTextBytes);
  }
  if (problems.count() > 0) return tl::unexpected(problems.errors().front());
  return header;
}

}  // namespace woodlouse::server
