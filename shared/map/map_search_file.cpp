#include "shared/map/map_search_file.h"

#include <system_error>

namespace woodlouse::map {
namespace {

namespace fs = std::filesystem;

/// Where the program lies.
fs::path program_folder() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path(".") : self.parent_path();
}

}  // namespace

core::Expected<fs::path> find_map(const std::string& word) {
  std::error_code error;
  if (fs::is_regular_file(word, error)) return fs::path(word);
  const std::string file = word.ends_with(".json") ? word : word + ".json";
  for (const fs::path& folder :
       {program_folder() / ".." / "share" / "woodlouse" / "maps", fs::path(WOODLOUSE_MAPS_DIR)}) {
    if (fs::is_regular_file(folder / file, error)) return (folder / file).lexically_normal();
  }
  if (fs::exists(word, error)) return fs::path(word);  // whoever reads it says what it is instead
  return core::fail(word, "no such file, and no map of that name came with the program",
                    "give the path of a map file, or a name: volcano, hills, torus");
}

}  // namespace woodlouse::map
