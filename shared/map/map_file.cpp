#include "shared/map/map_file.h"

#include "shared/core/whole_file.h"
#include "shared/map/grid_folder_file.h"

namespace woodlouse::map {
namespace {

/// The folder a map file lies in; never empty, which would forbid its grid file.
std::filesystem::path folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

core::Expected<std::shared_ptr<const Map>> parsed(const core::Expected<std::string>& text,
                                                  const std::filesystem::path& file) {
  if (!text) return tl::unexpected(text.error());
  const DiskFolder folder(folder_of(file));
  return parse_map(*text, file.string(), &folder);
}

}  // namespace

core::Expected<std::shared_ptr<const Map>> load_map(const std::filesystem::path& file) {
  return parsed(core::read_whole_file(file, kMaxMapBytes), file);
}

core::Expected<std::shared_ptr<const Map>> load_map_within(const std::filesystem::path& folder,
                                                           const std::filesystem::path& file) {
  return parsed(core::read_whole_file_within(folder, file, kMaxMapBytes), file);
}

std::vector<core::Error> check_map(const std::filesystem::path& file) {
  const core::Expected<std::string> text = core::read_whole_file(file, kMaxMapBytes);
  if (!text) return {text.error()};
  const DiskFolder folder(folder_of(file));
  return check_map(*text, file.string(), &folder);
}

}  // namespace woodlouse::map
