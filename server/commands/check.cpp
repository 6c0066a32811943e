#include "server/commands/check.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>

#include "server/commands/author_time.h"
#include "server/commands/map_summary.h"
#include "shared/core/printable.h"
#include "shared/map/map_file.h"
#include "shared/physics/central_gravity.h"
#include "shared/rules/climb.h"

namespace woodlouse::server {
namespace {

/// What whoever made a map that is fine had better know; empty: nothing.
std::string remark_on(const state::Parameters& physics) {
  if (!(physics.central_gravity > 0.0)) return {};
  const double usual = physics::default_core_radius(physics.central_gravity);
  if (physics.core_radius >= usual) return {};
  const double rate = physics::resolving_rate(physics.central_gravity, physics.core_radius);
  return fmt::format(
      "physics.core_radius: {:.3g} m is resolved from {:.0f} ticks a second on: below, a louse that passes "
      "through it "
      "goes astray (left out it is {:.3g} m, for 15 ticks a second and up)",
      physics.core_radius, std::ceil(rate), usual);
}

/// Thrust that no gate asks to be saved up is held down by whoever plays. A gate in the air wants speed on
/// any slope, and a pull that is not downwards knows no slopes.
std::string remark_on_run_ups(const map::Map& map) {
  const auto& gates = map.definition.modes.race->gates;
  const bool flies =
      std::any_of(gates.begin(), gates.end(), [](const map::Gate& gate) { return gate.in_air; });
  if (flies || map.definition.physics.central_gravity > 0.0 || rules::length_of_run_ups(map) > 0.0) return {};
  return "race: full thrust climbs every stretch from rest: no gate wants a run-up";
}

/// What is to be said of a map that can be read; an error: that it is not fine all the same.
core::Expected<std::vector<std::string>> remarks_on(const map::Map& map, const std::filesystem::path& file) {
  std::vector<std::string> remarks = {map.definition.ground_note, remark_on(map.definition.physics)};
  if (map.definition.modes.race) {
    remarks.push_back(remark_on_run_ups(map));
    auto author_time = judge_author_time(map, file);
    if (!author_time) return tl::unexpected(std::move(author_time.error()));
    remarks.push_back(std::move(*author_time));
  }
  remarks.erase(std::remove(remarks.begin(), remarks.end(), std::string()), remarks.end());
  return remarks;
}

}  // namespace

int check_command(const std::vector<std::filesystem::path>& maps, bool summary, std::ostream& out) {
  int exit_code = 0;
  for (const std::filesystem::path& file : maps) {
    const auto map = map::load_map(file);
    if (!map) {
      for (const core::Error& error : map::check_map(file)) out << error.text() << '\n';
      exit_code = 1;
      continue;
    }
    const auto remarks = remarks_on(**map, file);
    if (!remarks) {
      out << remarks.error().text() << '\n';
      exit_code = 1;
      continue;
    }
    const std::string name = core::printable(file.string());
    out << name << ": ok\n";
    for (const std::string& remark : *remarks) out << name << ": note: " << remark << '\n';
    if (!summary) continue;
    for (const std::string& line : summary_of(**map)) out << name << ": " << line << '\n';
  }
  return exit_code;
}

}  // namespace woodlouse::server
