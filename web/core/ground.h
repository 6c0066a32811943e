// Maps that the page has open.
#pragma once

#include <memory>

#include "shared/map/map_definition.h"
#include "web/core/handles.h"

namespace woodlouse::web {

/// A handle on a map that somebody has.
Handle open_ground(std::shared_ptr<const map::Map> map);
/// REQUIRES an open one.
const std::shared_ptr<const map::Map>& ground(Handle handle);

}  // namespace woodlouse::web
