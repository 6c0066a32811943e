#include "shared/replay/source_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "shared/replay/recorded_map_file.h"

namespace woodlouse::replay {
namespace {

using Stream = std::unique_ptr<std::istream>;

core::Expected<Stream> open_file(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    return core::fail(file.string(), "is a folder, not a recording");
  errno = 0;
  auto in = std::make_unique<std::ifstream>(file, std::ios::binary);
  if (!*in) return core::fail(file.string(), std::string("can't be opened: ") + std::strerror(errno));
  return unpacked(std::move(in));
}

}  // namespace

ReplaySource source_of_file(const std::filesystem::path& file) {
  return {file.string(), [file] { return open_file(file); },
          [folder = file.parent_path()](const Header& header) { return load_named_map(header, folder); }};
}

}  // namespace woodlouse::replay
