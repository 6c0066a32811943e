#include "shared/replay/recorded_map_file.h"

#include <cassert>
#include <system_error>

#include "shared/map/map_file.h"

namespace woodlouse::replay {

namespace fs = std::filesystem;

fs::path map_file_of(const Header& header, const MapPlaces& places) {
  if (header.map_file.empty()) return {};
  const fs::path name = fs::path(header.map_file).filename();
  const fs::path beside = places.recording / name;
  std::error_code error;
  return places.maps.empty() || fs::exists(beside, error) ? beside : places.maps / name;
}

core::Expected<MapPointer> load_named_map(const Header& header, const MapPlaces& places) {
  assert(header.map_definition.empty());
  const fs::path file = map_file_of(header, places);
  std::error_code error;
  if (!file.has_filename() || !fs::exists(file, error)) {
    return core::fail(file.string(), "no such file",
                      "put the map it was played on beside the recording, or say --maps FOLDER");
  }
  return file.parent_path() == places.recording ? map::load_map_within(places.recording, file)
                                                : map::load_map(file);
}

}  // namespace woodlouse::replay
