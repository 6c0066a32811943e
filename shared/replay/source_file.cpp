#include "shared/replay/source_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "shared/core/whole_file.h"
#include "shared/replay/recorded_map_file.h"

namespace woodlouse::replay {
namespace {

using Stream = std::unique_ptr<std::istream>;

core::Expected<Stream> open_file(const std::filesystem::path& file) {
  if (auto regular = core::check_regular_file(file); !regular) return tl::unexpected(regular.error());
  errno = 0;
  auto in = std::make_unique<std::ifstream>(file, std::ios::binary);
  if (!*in) return core::fail(file.string(), std::string("can't be opened: ") + std::strerror(errno));
  return unpacked(std::move(in));
}

}  // namespace

ReplaySource source_of_file(const std::filesystem::path& file, const std::filesystem::path& maps) {
  return {file.string(), [file] { return open_file(file); },
          [places = MapPlaces{file.parent_path(), maps}](const Header& header) {
            return load_named_map(header, places);
          }};
}

}  // namespace woodlouse::replay
