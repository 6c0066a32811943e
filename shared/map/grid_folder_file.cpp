#include "shared/map/grid_folder_file.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "shared/core/input_file.h"
#include "shared/core/whole_file.h"
#include "shared/elevation/hgt_grid_file.h"
#include "shared/map/float_grid_reader.h"
#include "shared/map/flt_grid_file.h"
#include "shared/map/map_text.h"

namespace woodlouse::map {

namespace fs = std::filesystem;

DiskFolder::DiskFolder(fs::path folder) : folder_(std::move(folder)) { assert(!folder_.empty()); }

core::Expected<std::string> DiskFolder::find(std::string_view name) const {
  const fs::path relative(name);
  const bool climbs =
      std::any_of(relative.begin(), relative.end(), [](const auto& part) { return part == ".."; });
  if (relative.is_absolute() || climbs) {
    return core::fail({}, "leaves the map's folder",
                      "put the grid beside the map and name it without a path");
  }
  return (folder_ / relative).string();
}

core::Expected<std::string> DiskFolder::read_text(const std::string& path) const {
  return core::read_whole_file_within(folder_, path, kMaxMapBytes);
}

core::Expected<std::shared_ptr<const terrain::HeightSource>> DiskFolder::open_heights(
    const std::string& path, std::optional<core::Vec2> corner) const {
  if (is_srtm_tile(path)) {
    auto file = core::InputFile::open_within(folder_, path);
    if (!file) return tl::unexpected(file.error());
    auto tile = elevation::HgtGrid::open(std::move(*file), corner);
    if (!tile) return tl::unexpected(tile.error());
    return std::shared_ptr<const terrain::HeightSource>(std::move(*tile));
  }
  auto grid = FltGrid::open_within(folder_, path);
  if (!grid) return tl::unexpected(grid.error());
  return std::shared_ptr<const terrain::HeightSource>(std::move(*grid));
}

}  // namespace woodlouse::map
