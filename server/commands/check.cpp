#include "server/commands/check.h"

#include <ostream>

#include "shared/core/printable.h"
#include "shared/map/map_file.h"

namespace woodlouse::server {

int check_command(const std::vector<std::filesystem::path>& maps, std::ostream& out) {
  int exit_code = 0;
  for (const std::filesystem::path& file : maps) {
    const std::vector<core::Error> errors = map::check_map(file);
    if (errors.empty()) out << core::printable(file.string()) << ": ok\n";
    for (const core::Error& error : errors) out << error.text() << '\n';
    if (!errors.empty()) exit_code = 1;
  }
  return exit_code;
}

}  // namespace woodlouse::server
