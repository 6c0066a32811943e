#include "shared/map/flt_grid_file.h"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "shared/elevation/ground.h"

namespace woodlouse::map {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1u << 16;

std::uint32_t swapped(std::uint32_t v) {
  return (v >> 24) | ((v >> 8) & 0xff00u) | ((v << 8) & 0xff0000u) | (v << 24);
}

}  // namespace

core::Expected<std::shared_ptr<const FltGrid>> FltGrid::open(const std::filesystem::path& file) {
  return open_by(core::InputFile::open, file);
}

core::Expected<std::shared_ptr<const FltGrid>> FltGrid::open_within(const std::filesystem::path& folder,
                                                                    const std::filesystem::path& file) {
  return open_by(
      [&folder](const std::filesystem::path& named) { return core::InputFile::open_within(folder, named); },
      file);
}

core::Expected<std::shared_ptr<const FltGrid>> FltGrid::open_by(const Open& open,
                                                                const std::filesystem::path& file) {
  std::filesystem::path header_file = file;
  header_file.replace_extension(".hdr");
  if (std::error_code error;
      std::filesystem::exists(file, error) && !std::filesystem::exists(header_file, error)) {
    return core::fail(header_file.string(), "no such file",
                      "the header of " + file.filename().string() + "; gdal_translate -of EHdr writes both");
  }
  const auto header_input = open(header_file);
  if (!header_input) return tl::unexpected(header_input.error());
  const auto text = header_input->read_all(kMaxHeaderBytes);
  if (!text) return tl::unexpected(text.error());
  const auto header = parse_flt_header(*text, header_file.string());
  if (!header) return tl::unexpected(header.error());

  if (std::error_code error; !std::filesystem::exists(file, error)) {
    return core::fail(file.string(), "no such file",
                      "the heights that " + header_file.filename().string() + " describes; check the path");
  }
  auto heights = open(file);
  if (!heights) return tl::unexpected(heights.error());
  const std::size_t expected = 4 * header->frame.columns * header->frame.rows;
  if (heights->size() != expected) {
    return core::fail(
        file.string(),
        "has " + std::to_string(heights->size()) + " bytes, its header says " + std::to_string(expected),
        "4 bytes for each of nrows * ncols heights; compare it with " + header_file.string());
  }
  // A tile's rows lie far apart: without this the system reads 128 KB around each, and soon holds the whole
  // file. Advice: where it is not taken, only that happens.
  static_cast<void>(::posix_fadvise(heights->descriptor(), 0, 0, POSIX_FADV_RANDOM));
  return std::shared_ptr<const FltGrid>(new FltGrid(*header, std::move(*heights)));
}

std::optional<double> FltGrid::undeclared_mark() const {
  const unsigned met = marks_met_.load(std::memory_order_relaxed);
  for (std::size_t k = 0; k < elevation::kCustomaryMarks.size(); ++k) {
    if ((met >> k & 1u) != 0) return elevation::kCustomaryMarks[k];
  }
  return std::nullopt;
}

bool FltGrid::is_customary_mark(float height) const {
  if (!(height <= -9999.0f)) return false;  // nearly all heights end here
  for (std::size_t k = 0; k < elevation::kCustomaryMarks.size(); ++k) {
    if (static_cast<double>(height) != elevation::kCustomaryMarks[k]) continue;
    marks_met_.fetch_or(1u << k, std::memory_order_relaxed);
    return true;
  }
  return false;
}

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
    const bool ok = heights_.read_at(std::as_writable_bytes(raw), 4 * (first + done));
    if (!ok) read_failures_.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t k = 0; k < part.size(); ++k) {
      const float height = std::bit_cast<float>(swap ? swapped(raw[k]) : raw[k]);
      const bool known = ok && std::fabs(height) < kNoFloatHeightFrom && height != header_.no_data &&
                         (header_.declares_no_data || !is_customary_mark(height));
      part[k] = known ? static_cast<double>(height) : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace woodlouse::map
