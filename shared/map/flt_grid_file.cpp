#include "shared/map/flt_grid_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <system_error>

#include "shared/core/whole_file.h"

namespace woodlouse::map {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1u << 16;

core::Expected<std::size_t> size_of(int descriptor, const std::filesystem::path& file) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    return core::fail(file.string(), std::string("can't be examined: ") + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode))
    return core::fail(file.string(), "is no regular file", "a float grid is read in any order");
  return static_cast<std::size_t>(status.st_size);
}

/// Whether all of `bytes` could be read from `offset` on.
bool read_at(int descriptor, std::span<std::byte> bytes, std::size_t offset) {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::size_t>(count);
  }
  return true;
}

std::uint32_t swapped(std::uint32_t v) {
  return (v >> 24) | ((v >> 8) & 0xff00u) | ((v << 8) & 0xff0000u) | (v << 24);
}

}  // namespace

core::Expected<std::shared_ptr<const FltGrid>> FltGrid::open(const std::filesystem::path& file) {
  std::filesystem::path header_file = file;
  header_file.replace_extension(".hdr");
  if (std::error_code error;
      std::filesystem::exists(file, error) && !std::filesystem::exists(header_file, error)) {
    return core::fail(header_file.string(), "no such file",
                      "the header of " + file.filename().string() + "; gdal_translate -of EHdr writes both");
  }
  const auto text = core::read_whole_file(header_file, kMaxHeaderBytes);
  if (!text) return tl::unexpected(text.error());
  const auto header = parse_flt_header(*text, header_file.string());
  if (!header) return tl::unexpected(header.error());

  if (std::error_code error; std::filesystem::exists(file, error)) {
    if (auto regular = core::check_regular_file(file); !regular) return tl::unexpected(regular.error());
  }
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    return core::fail(
        file.string(), std::string("can't be opened: ") + std::strerror(errno),
        "the heights that " + header_file.filename().string() + " describes; check the path and its rights");
  std::shared_ptr<const FltGrid> grid(new FltGrid(*header, descriptor));  // owns the descriptor from here on
  const auto size = size_of(descriptor, file);
  if (!size) return tl::unexpected(size.error());
  const std::size_t expected = 4 * header->frame.columns * header->frame.rows;
  if (*size != expected) {
    return core::fail(file.string(),
                      "has " + std::to_string(*size) + " bytes, its header says " + std::to_string(expected),
                      "4 bytes for each of nrows * ncols heights; compare it with " + header_file.string());
  }
  // A tile's rows lie far apart: without this the system reads 128 KB around each, and soon holds the whole
  // file. Advice: where it is not taken, only that happens.
  static_cast<void>(::posix_fadvise(descriptor, 0, 0, POSIX_FADV_RANDOM));
  return grid;
}

FltGrid::~FltGrid() { ::close(descriptor_); }

void FltGrid::read(std::size_t column, std::size_t row, std::span<double> out) const {
  const terrain::GridFrame& frame = header_.frame;
  assert(column + out.size() <= frame.columns && row < frame.rows);
  const std::size_t first =
      (frame.rows - 1 - row) * frame.columns + column;  // the file's first row is the northern one
  const bool swap =
      (header_.byte_order == ByteOrder::kLittleEndian) != (std::endian::native == std::endian::little);
  std::array<std::uint32_t, 4096> words;
  for (std::size_t done = 0; done < out.size(); done += words.size()) {
    const std::span<double> part = out.subspan(done, std::min(words.size(), out.size() - done));
    const std::span<std::uint32_t> raw(words.data(), part.size());
    const bool ok = read_at(descriptor_, std::as_writable_bytes(raw), 4 * (first + done));
    if (!ok) read_failures_.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t k = 0; k < part.size(); ++k) {
      const float height = std::bit_cast<float>(swap ? swapped(raw[k]) : raw[k]);
      const bool known = ok && std::fabs(height) < kNoFloatHeightFrom && height != header_.no_data;
      part[k] = known ? static_cast<double>(height) : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace woodlouse::map
