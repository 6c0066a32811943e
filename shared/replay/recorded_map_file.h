// The file of a map that a recording only names.
#pragma once

#include <filesystem>

#include "shared/replay/source.h"

namespace woodlouse::replay {

/// The only folders a recording's map is looked for in: whoever wrote the recording has no say in what is
/// opened. What lies beside the recording may have come with it: a link out of that folder is not followed.
/// `maps` is the user's own: what he links there is meant to be found.
struct MapPlaces {
  std::filesystem::path recording;  ///< its folder
  std::filesystem::path maps;       ///< whoever reads it named this one; empty: nobody did
};

/// The map that the header names. Errors: no such file, not a map. Whether it is the recorded one
/// recorded_map() asks.
core::Expected<MapPointer> load_named_map(const Header& header, const MapPlaces& places);

/// The file of a map that is only named, by the last part of its path: beside the recording, else in
/// places.maps. Empty where the header has the map itself.
std::filesystem::path map_file_of(const Header& header, const MapPlaces& places);

}  // namespace woodlouse::replay
