// A grid file as it is, whichever kind: its heights where its own coordinates say, before a map lays them
// out.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "shared/core/error.h"
#include "shared/elevation/ground.h"
#include "shared/json/fields.h"
#include "shared/map/grid_folder.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::map {

/// The grid of a text, of ESRI or of Surfer; `path` names it in errors. Nothing, and at least one problem,
/// when something is wrong.
std::optional<elevation::FileGrid> parse_grid_text(const std::string& text, const std::string& path,
                                                   json::Problems& problems);

struct OpenedGrid {
  /// In the file's own frame and height unit. A text's are in memory, others are read where they are asked
  /// for.
  std::shared_ptr<const terrain::HeightSource> heights;
  bool is_in_degrees = false;  ///< the frame, by the looks of the whole grid; an SRTM tile's always
};

/// The file `name` of the folder. Errors: as of a map that names it.
core::Expected<OpenedGrid> open_grid(const GridFolder& folder, const std::string& name);

}  // namespace woodlouse::map
