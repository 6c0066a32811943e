#include "shared/replay/recorded_map.h"

#include <system_error>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/map/map_loader.h"

namespace woodlouse::replay {
namespace {

using core::joined;
using MapPointer = std::shared_ptr<const map::Map>;

}  // namespace

std::filesystem::path map_file_of(const Header& header, const std::filesystem::path& folder) {
  if (header.map_file.empty()) return {};
  const std::filesystem::path recorded(header.map_file);
  std::error_code error;
  const std::filesystem::path beside = folder / recorded.filename();
  return std::filesystem::exists(beside, error) ? beside : recorded;
}

core::Expected<MapPointer> load_recorded_map(const Header& header, const std::string& source,
                                             const std::filesystem::path& folder) {
  const std::filesystem::path file = map_file_of(header, folder);
  std::error_code error;
  if (!file.empty() && !std::filesystem::exists(file, error)) {
    return core::fail(file.string(), "no such file", "put the map it was played on beside the recording");
  }
  core::Expected<MapPointer> map =
      header.map_definition.empty()
          ? map::load_map(file)
          : map::parse_map(header.map_definition, joined({source, ":1: map.definition"}), {});
  if (map && (*map)->hash != header.map_hash) {
    return core::fail(joined({source, ":1: map.hash"}),
                      joined({"the map's hash is ", core::to_hex((*map)->hash), ", recorded is ",
                              core::to_hex(header.map_hash)}),
                      header.map_definition.empty() ? "put the map it was played on beside the recording"
                                                    : "the map in the recording was altered");
  }
  return map;
}

}  // namespace woodlouse::replay
