// The first line of a recording.
#pragma once

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/replay/format.h"

namespace woodlouse::replay {

/// The header, every field checked. A line of another format, version or behavior is one problem, that names
/// both.
Header read_header(const json::Value& root, json::Problems& problems);

}  // namespace woodlouse::replay
