#include "shared/replay/source_file.h"

#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>

#include "shared/core/input_file.h"
#include "shared/core/printable.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/recorded_map_file.h"

namespace woodlouse::replay {
namespace {

using Stream = std::unique_ptr<std::istream>;

/// A file's bytes, to be read and sought in.
class FileBytes final : public FaultTellingBuffer {
 public:
  /// Owns the descriptor.
  explicit FileBytes(int descriptor) : descriptor_(descriptor) { assert(descriptor >= 0); }
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  ~FileBytes() override { ::close(descriptor_); }

 protected:
  int_type underflow() override {
    if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
    ssize_t got = 0;
    do {
      got = ::read(descriptor_, buffer_.data(), buffer_.size());
    } while (got < 0 && errno == EINTR);
    if (got < 0) fault_ = std::string("can't be read: ") + std::strerror(errno);
    if (got <= 0) return traits_type::eof();
    setg(buffer_.data(), buffer_.data(), buffer_.data() + got);
    return traits_type::to_int_type(*gptr());
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    // The descriptor stands at the end of what is buffered.
    if (from == std::ios_base::cur) offset -= egptr() - gptr();
    const int whence = from == std::ios_base::beg   ? SEEK_SET
                       : from == std::ios_base::cur ? SEEK_CUR
                                                    : SEEK_END;
    const off_t position = ::lseek(descriptor_, offset, whence);
    setg(nullptr, nullptr, nullptr);
    return position < 0 ? pos_type(off_type(-1)) : pos_type(position);
  }

  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }

 private:
  int descriptor_;
  std::array<char, 1 << 16> buffer_{};
};

core::Expected<Stream> open_file(const std::filesystem::path& file) {
  auto input = core::InputFile::open(file);
  if (!input) return tl::unexpected(input.error());
  return unpacked(std::make_unique<BufferStream<FileBytes>>(input->release()));
}

}  // namespace

ReplaySource source_of_file(const std::filesystem::path& file, const std::filesystem::path& maps) {
  return {core::printable(file.string()), [file] { return open_file(file); },
          [places = MapPlaces{file.parent_path(), maps}](const Header& header) {
            return load_named_map(header, places);
          }};
}

}  // namespace woodlouse::replay
