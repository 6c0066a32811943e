// Reads maps: every byte is checked here, once. Format: maps/README.md.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "shared/core/error.h"
#include "shared/map/grid_folder.h"
#include "shared/map/map_definition.h"

namespace woodlouse::map {

inline constexpr std::size_t kMaxMapBytes = 128u
                                            << 20;   ///< of a map or grid file; room for kMaxKnots heights
inline constexpr std::size_t kMaxKnots = 4'000'000;  ///< of one terrain

/// The map of a JSON text. `source` names it in errors; a grid file is looked up in `folder`. Null allows
/// none: a text that came over a wire reads no files here. Errors: where = "file:line: field", what, hint.
core::Expected<std::shared_ptr<const Map>> parse_map(std::string_view text, std::string_view source,
                                                     const GridFolder* folder);

/// A map that a program wrote, as into a recording: `text` must be its own canonical text (canonical_map.h).
/// So a short text makes no large map: a spline's heights stand in it. Errors as above, or that it is
/// another.
core::Expected<std::shared_ptr<const Map>> parse_canonical_map(std::string_view text,
                                                               std::string_view source);

/// A big map as a client gets it: the text of its definition, which names a file that is not here, and an
/// overview of that file's heights. Detail::kOverview; its hash is that of the text. Errors as above.
core::Expected<std::shared_ptr<const Map>> parse_overview(std::string_view text, std::string_view source,
                                                          const terrain::HeightGrid& overview);

/// What is wrong with a map's text, told as json::Problems tells it; empty: nothing. As parse_map().
std::vector<core::Error> check_map(std::string_view text, std::string_view source, const GridFolder* folder);

}  // namespace woodlouse::map
