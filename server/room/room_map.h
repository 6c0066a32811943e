// What a room tells of its map: made once, when the room opens.
#pragma once

#include "server/frames/frame.h"
#include "shared/map/map_definition.h"

namespace woodlouse::server {

/// The `map` message: the definition, the knots where it only names a function, and an overview where it
/// names a file.
Line encode_map_line(const map::Map& map);

}  // namespace woodlouse::server
