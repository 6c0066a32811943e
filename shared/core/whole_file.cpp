#include "shared/core/whole_file.h"

#include "shared/core/input_file.h"

namespace woodlouse::core {

Expected<std::string> read_whole_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const auto input = InputFile::open(file);
  if (!input) return tl::unexpected(input.error());
  return input->read_all(max_bytes);
}

Expected<std::string> read_whole_file_within(const std::filesystem::path& folder,
                                             const std::filesystem::path& file, std::size_t max_bytes) {
  const auto input = InputFile::open_within(folder, file);
  if (!input) return tl::unexpected(input.error());
  return input->read_all(max_bytes);
}

}  // namespace woodlouse::core
