#include "server/commands/check.h"

#include <ostream>
#include <string>

#include "shared/core/joined.h"
#include "shared/core/printable.h"
#include "shared/json/text.h"
#include "shared/map/map_file.h"
#include "shared/physics/central_gravity.h"

namespace woodlouse::server {
namespace {

/// What a map that is fine had better be told; empty: nothing.
std::string remark_of(const std::filesystem::path& file) {
  const auto map = map::load_map(file);
  if (!map) return {};
  const state::Parameters& physics = (*map)->definition.physics;
  if (!(physics.central_gravity > 0.0)) return {};
  const double usual = physics::default_core_radius(physics.central_gravity);
  if (physics.core_radius >= usual) return {};
  const double rate = physics::resolving_rate(physics.central_gravity, physics.core_radius);
  return core::joined(
      {"physics.core_radius: ", json::double_text(physics.core_radius), " m is resolved from ",
       std::to_string(static_cast<long long>(rate) + 1),
       " ticks a second on; below, a louse that passes through it goes astray (left out it is ",
       json::double_text(usual), " m, for 15 ticks a second and up)"});
}

}  // namespace

int check_command(const std::vector<std::filesystem::path>& maps, std::ostream& out) {
  int exit_code = 0;
  for (const std::filesystem::path& file : maps) {
    const std::vector<core::Error> errors = map::check_map(file);
    if (errors.empty()) {
      out << core::printable(file.string()) << ": ok\n";
      if (const std::string remark = remark_of(file); !remark.empty())
        out << core::printable(file.string()) << ": note: " << remark << '\n';
    }
    for (const core::Error& error : errors) out << error.text() << '\n';
    if (!errors.empty()) exit_code = 1;
  }
  return exit_code;
}

}  // namespace woodlouse::server
