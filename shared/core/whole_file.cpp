#include "shared/core/whole_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "shared/core/joined.h"

namespace woodlouse::core {

Expected<void> check_regular_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return fail(file.string(), "no such file", "check the path, and the folder it starts from");
  }
  if (std::filesystem::is_directory(status)) return fail(file.string(), "is a folder, not a file");
  if (!std::filesystem::is_regular_file(status))
    return fail(file.string(), "is no regular file", "pipes, devices and sockets are not read");
  return {};
}

Expected<std::string> read_whole_file(const std::filesystem::path& file, std::size_t max_bytes) {
  if (auto regular = check_regular_file(file); !regular) return tl::unexpected(regular.error());
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(file.string(), std::string("can't be opened: ") + std::strerror(errno));
  // Read rather than trust a size: it may grow, and files of /proc have none.
  std::string bytes;
  constexpr std::size_t kChunk = 1u << 16;
  while (in && bytes.size() <= max_bytes) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kChunk);
    in.read(bytes.data() + before, kChunk);
    bytes.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) return fail(file.string(), "can't be read to its end");
  if (bytes.size() > max_bytes) {
    return fail(file.string(), joined({"longer than ", std::to_string(max_bytes >> 20), " MiB"}));
  }
  return bytes;
}

}  // namespace woodlouse::core
