#include "bench/scenario/scenario_reader.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "bench/scenario/script_reader.h"
#include "shared/core/joined.h"
#include "shared/core/whole_file.h"
#include "shared/json/fields.h"
#include "shared/map/grid_folder_file.h"
#include "shared/map/map_file.h"

namespace woodlouse::scenario {
namespace {

using json::Problems;
using MapPointer = std::shared_ptr<const map::Map>;

constexpr std::size_t kMaxBytes = 16u << 20;

template <typename Number>
std::optional<Number> whole_text(std::string_view text, int base) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Span place_of(const json::Value& value, std::string_view text) {
  return {static_cast<std::size_t>(value.raw().data() - text.data()), value.raw().size()};
}

std::filesystem::path nearest_maps(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::absolute(file, error).parent_path();
  for (; !folder.empty(); folder = folder.parent_path()) {
    if (std::filesystem::is_directory(folder / "maps", error)) return folder / "maps";
    if (folder == folder.parent_path()) break;
  }
  return "maps";
}

/// So that the map's reader counts lines as in the scenario's file.
std::string lines_before(const json::Value& value) { return std::string(value.line() - 1, '\n'); }

MapPointer keep(core::Expected<MapPointer> map, Problems& problems) {
  if (map) return std::move(*map);
  problems.add(map.error());
  return nullptr;
}

/// Where the map's own files lie.
std::filesystem::path folder_of_map(const json::Value& value, const std::filesystem::path& file,
                                    const std::filesystem::path& maps) {
  if (!value.is(json::Kind::kObject)) return maps.empty() ? nearest_maps(file) : maps;
  return file.has_parent_path() ? file.parent_path() : ".";
}

/// `maps`: the folder that the user named, whose links are his own; empty: `folder` was found.
MapPointer read_map(const json::Value& value, const std::filesystem::path& file,
                    const std::filesystem::path& folder, const std::filesystem::path& maps,
                    Problems& problems) {
  if (value.is(json::Kind::kObject)) {
    const map::DiskFolder grids(folder);
    return keep(map::parse_map(lines_before(value) + std::string(value.raw()), file.string(), &grids),
                problems);
  }
  if (!value.is(json::Kind::kString)) {
    problems.add(value, "a map's name, or the map itself, is wanted");
    return nullptr;
  }
  const std::filesystem::path found = folder / core::joined({value.text(), ".json"});
  std::error_code error;
  if (value.text().find('/') != std::string_view::npos || !std::filesystem::is_regular_file(found, error)) {
    problems.add(value, core::joined({"no map \"", value.text(), "\" in ", folder.string()}),
                 "give its name without .json, or --maps FOLDER");
    return nullptr;
  }
  return keep(maps.empty() ? map::load_map_within(folder, found) : map::load_map(found), problems);
}

/// The map with the scenario's own spawns. They end a canonical map; so its reader checks them in their
/// place.
MapPointer with_spawns(const MapPointer& map, const json::Value& spawns, const std::filesystem::path& file,
                       const std::filesystem::path& folder, Problems& problems) {
  constexpr std::string_view kKey = ",\"spawns\":";
  const std::size_t at = map->canonical.rfind(kKey);
  assert(at != std::string::npos);
  const std::string_view own = spawns.is(json::Kind::kArray) ? spawns.raw() : "null";
  const std::string text =
      core::joined({lines_before(spawns), std::string_view(map->canonical).substr(0, at), kKey, own, "}"});
  const map::DiskFolder grids(folder);
  return keep(map::parse_map(text, file.string(), &grids), problems);
}

std::vector<GoldenHash> read_goldens(const json::Value& value, Problems& problems) {
  std::vector<GoldenHash> goldens;
  const auto wrong = [&](const json::Value& member, std::string what) {
    problems.add(member, std::move(what), R"("tick": "16 hex digits", or null until --update fills it in)");
  };
  for (const json::Value& member : value.children()) {
    const auto tick = whole_text<std::uint64_t>(member.key(), 10);
    if (!tick || *tick == 0 || *tick > kMaxTicks) {
      wrong(member, core::joined({"is no tick from 1 to ", std::to_string(kMaxTicks)}));
      continue;
    }
    if (!goldens.empty() && *tick <= goldens.back().tick) wrong(member, "stands after a later tick");
    GoldenHash golden{*tick, std::nullopt};
    if (member.is(json::Kind::kString) && member.text().size() == 16)
      golden.hash = whole_text<std::uint64_t>(member.text(), 16);
    if (!golden.hash && !member.is(json::Kind::kNull)) wrong(member, "is no hash");
    goldens.push_back(golden);
  }
  if (goldens.empty() && problems.count() == 0) wrong(value, "an object with at least one tick is wanted");
  return goldens;
}

void read_mode(const json::Value& value, Scenario& scenario, Problems& problems) {
  const auto mode = json::choice_of(value, state::mode_from_text);
  if (!mode) return problems.add(value, "is no mode", "roam, race, forage or hill");
  if (scenario.map && !scenario.map->definition.modes.has(*mode))
    return problems.add(value, "the map has no such mode");
  scenario.settings.mode = *mode;
}

std::vector<std::string> read_rulings(const json::Value& value, Problems& problems) {
  std::vector<std::string> rulings;
  if (!value.is(json::Kind::kArray))
    problems.add(value, "a list of texts is wanted", "[] until --update fills it in");
  for (const json::Value& ruling : value.children())
    rulings.push_back(json::text_in(ruling, 1, 200, problems).value_or(""));
  return rulings;
}

Scenario read_fields(const json::Value& root, const std::filesystem::path& file,
                     const std::filesystem::path& maps, std::string_view text, Problems& problems) {
  constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
  constexpr std::uint64_t kMaxBehavior = 1'000'000;
  Scenario scenario;
  const json::Fields fields(
      root, {"about", "behavior", "map", "mode", "spawns", "tick_hz", "seed", "script", "hashes", "rulings"},
      problems);
  if (const auto about = fields.find("about")) json::text_in(*about, 1, 1000, problems);
  if (const auto behavior = fields.demand("behavior", "0 until --update sets it")) {
    scenario.behavior = static_cast<int>(json::integer_in(*behavior, 0, kMaxBehavior, problems).value_or(0));
    if (!behavior->is(json::Kind::kString)) scenario.behavior_place = place_of(*behavior, text);
  }
  if (const auto map = fields.demand("map")) {
    const std::filesystem::path folder = folder_of_map(*map, file, maps);
    const auto spawns = fields.find("spawns");
    scenario.map = read_map(*map, file, folder, maps, problems);
    if (spawns && scenario.map) scenario.map = with_spawns(scenario.map, *spawns, file, folder, problems);
  }
  if (const auto hz = fields.find("tick_hz")) {
    scenario.settings.tick_hz =
        static_cast<std::uint32_t>(json::integer_in(*hz, 1, 1000, problems).value_or(60));
  }
  if (const auto seed = fields.find("seed")) {
    scenario.settings.seed = json::integer_in(*seed, 0, kAny, problems).value_or(0);
  }
  if (const auto mode = fields.find("mode")) read_mode(*mode, scenario, problems);
  if (const auto rulings = fields.find("rulings")) {
    scenario.rulings = read_rulings(*rulings, problems);
    scenario.rulings_place = place_of(*rulings, text);
  }
  const auto script = fields.demand("script");
  if (const auto hashes = fields.demand("hashes", "\"hashes\": {\"60\": null}, and --update fills them in")) {
    scenario.goldens = read_goldens(*hashes, problems);
    if (!hashes->is(json::Kind::kString)) scenario.goldens_place = place_of(*hashes, text);
    scenario.goldens_line = hashes->line();
  }
  if (script && !scenario.goldens.empty()) {
    scenario.events = read_script(*script, scenario.last_tick(), scenario.settings.seed, problems);
  }
  return scenario;
}

}  // namespace

ReadScenario read_scenario(const std::filesystem::path& file, const std::filesystem::path& maps) {
  auto text = core::read_whole_file(file, kMaxBytes);
  if (!text) return {std::nullopt, {text.error()}};
  Problems problems(file.string());
  const auto document = json::parse_file(*text, file.string(), {});
  if (!document) return {std::nullopt, {document.error()}};
  Scenario scenario = read_fields(document->root(), file, maps, *text, problems);
  if (problems.count() != 0) return {std::nullopt, std::move(problems).told()};
  scenario.name = file.stem().string();
  scenario.file = file;
  scenario.text = std::move(*text);
  return {std::move(scenario), {}};
}

core::Expected<std::vector<std::filesystem::path>> find_scenarios(
    const std::vector<std::filesystem::path>& places) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& place : places) {
    std::error_code error;
    if (!std::filesystem::is_directory(place, error)) {
      files.push_back(place);
      continue;
    }
    const std::size_t before = files.size();
    std::filesystem::directory_iterator entry(place, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
      if (entry->path().extension() == ".json") files.push_back(entry->path());
    }
    if (error) return core::fail(place.string(), core::joined({"can't be listed: ", error.message()}));
    if (files.size() == before) return core::fail(place.string(), "holds no scenario", "they end in .json");
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.stem() < b.stem(); });
  const auto twin = std::adjacent_find(files.begin(), files.end(),
                                       [](const auto& a, const auto& b) { return a.stem() == b.stem(); });
  if (twin != files.end()) {
    return core::fail(std::next(twin)->string(),
                      core::joined({"the scenario ", twin->stem().string(), " stands twice"}),
                      "a scenario is named by its file");
  }
  return files;
}

}  // namespace woodlouse::scenario
