#include "server/commands/check.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <ostream>
#include <string>

#include "shared/core/printable.h"
#include "shared/map/map_file.h"
#include "shared/physics/central_gravity.h"

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

}  // namespace

int check_command(const std::vector<std::filesystem::path>& maps, std::ostream& out) {
  int exit_code = 0;
  for (const std::filesystem::path& file : maps) {
    const auto map = map::load_map(file);
    if (!map) {
      for (const core::Error& error : map::check_map(file)) out << error.text() << '\n';
      exit_code = 1;
      continue;
    }
    const std::string name = core::printable(file.string());
    out << name << ": ok\n";
    const std::string remark = remark_on((*map)->definition.physics);
    if (!remark.empty()) out << name << ": note: " << remark << '\n';
  }
  return exit_code;
}

}  // namespace woodlouse::server
