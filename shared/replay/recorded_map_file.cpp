#include "shared/replay/recorded_map_file.h"

#include <cassert>
#include <system_error>

#include "shared/map/map_file.h"

namespace woodlouse::replay {

std::filesystem::path map_file_of(const Header& header, const std::filesystem::path& folder) {
  if (header.map_file.empty()) return {};
  const std::filesystem::path recorded(header.map_file);
  std::error_code error;
  const std::filesystem::path beside = folder / recorded.filename();
  return std::filesystem::exists(beside, error) ? beside : recorded;
}

core::Expected<MapPointer> load_named_map(const Header& header, const std::filesystem::path& folder) {
  assert(header.map_definition.empty());
  const std::filesystem::path file = map_file_of(header, folder);
  std::error_code error;
  if (!file.empty() && !std::filesystem::exists(file, error)) {
    return core::fail(file.string(), "no such file", "put the map it was played on beside the recording");
  }
  return map::load_map(file);
}

}  // namespace woodlouse::replay
