#include "shared/replay/source.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "shared/replay/zstd_input.h"

namespace woodlouse::replay {
namespace {

using Stream = std::unique_ptr<std::istream>;

/// Owns the buffer that it reads through.
class ZstdStream : public std::istream {
 public:
  explicit ZstdStream(Stream packed) : std::istream(nullptr), buffer_(std::move(packed)) { rdbuf(&buffer_); }

 private:
  ZstdInput buffer_;
};

/// zstd's frames and its skippable ones begin so.
bool is_compressed(std::istream& in) {
  std::array<unsigned char, 4> magic{};
  in.read(reinterpret_cast<char*>(magic.data()), magic.size());
  in.clear();
  in.seekg(0);
  const bool is_frame = magic == std::array<unsigned char, 4>{0x28, 0xB5, 0x2F, 0xFD};
  const bool is_skippable =
      (magic[0] & 0xF0) == 0x50 && magic[1] == 0x2A && magic[2] == 0x4D && magic[3] == 0x18;
  return is_frame || is_skippable;
}

Stream unpacked(Stream in) {
  if (!is_compressed(*in)) return in;
  return std::make_unique<ZstdStream>(std::move(in));
}

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

ReplaySource ReplaySource::of_file(const std::filesystem::path& file) {
  return {file.string(), file.parent_path(), [file] { return open_file(file); }};
}

ReplaySource ReplaySource::of_bytes(std::string bytes, std::string name,
                                    const std::filesystem::path& folder) {
  return {std::move(name), folder, [bytes = std::move(bytes)]() -> core::Expected<Stream> {
            return unpacked(std::make_unique<std::istringstream>(bytes));
          }};
}

}  // namespace woodlouse::replay
