// Where a recording's bytes come from: whoever has them opens streams on them. Compressed ones are told by
// their first bytes and unpacked on the way. source_file.h: from files.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/format.h"

namespace woodlouse::replay {

using MapPointer = std::shared_ptr<const map::Map>;

/// Who has maps in common for recordings that are read beside each other.
class Maps {
 public:
  Maps() = default;
  Maps(const Maps&) = delete;
  Maps& operator=(const Maps&) = delete;
  virtual ~Maps() = default;

  /// The map of that definition, byte for byte: one that somebody still has, else as make() makes it, in the
  /// caller's thread. Errors: make()'s.
  [[nodiscard]] virtual core::Expected<MapPointer> find_or(
      std::string_view definition, const std::function<core::Expected<MapPointer>()>& make) = 0;
};

/// Opens as many streams on one recording as are wanted: text, that can be sought in by the byte.
struct ReplaySource {
  std::string name;  ///< in errors
  std::function<core::Expected<std::unique_ptr<InputStream>>()> open;
  /// The map that a header only names; null: none is looked for.
  std::function<core::Expected<MapPointer>(const Header&)> find_map;

  /// `bytes`: plain or compressed.
  static ReplaySource of_bytes(std::string bytes, std::string name);
};

/// The text of what may be compressed.
std::unique_ptr<InputStream> unpacked(std::unique_ptr<InputStream> in);

/// The recorded map: the one in the header, or the one it names. Errors: it is not found, not a map, or
/// another one than was recorded. maps: of what is read beside it; null: none.
core::Expected<MapPointer> recorded_map(const Header& header, const ReplaySource& source,
                                        Maps* maps = nullptr);

}  // namespace woodlouse::replay
