// The folder that a map's grid file is looked up in, seen from where there may be no file system: whoever has
// one implements it (grid_folder_file.h). A map that came over a wire has none.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/core/vec2.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::map {

class GridFolder {
 public:
  GridFolder() = default;
  GridFolder(const GridFolder&) = delete;
  GridFolder& operator=(const GridFolder&) = delete;
  virtual ~GridFolder() = default;

  /// The path of the grid that a map names: for messages, and for the calls below. Errors: the name leads out
  /// of the folder (what and hint; where is the map's to say).
  [[nodiscard]] virtual core::Expected<std::string> find(std::string_view name) const = 0;
  /// A grid of text, whole. Errors: it can't be read, lies elsewhere, or is longer than
  /// a map may be.
  [[nodiscard]] virtual core::Expected<std::string> read_text(const std::string& path) const = 0;
  /// A grid of floats with its header, or an SRTM tile by its ending .hgt, read where heights are asked for.
  /// `corner` [degrees]: the tile's south-western one, in place of what its name says.
  [[nodiscard]] virtual core::Expected<std::shared_ptr<const terrain::HeightSource>> open_heights(
      const std::string& path, std::optional<core::Vec2> corner) const = 0;
};

}  // namespace woodlouse::map
