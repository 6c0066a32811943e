// ESRI float grids (.flt + .hdr): heights as raw 32-bit floats, for maps too big to load.
//
//     ncols 10001                   header keys in any case and order, beside the data as NAME.hdr
//     nrows 10001
//     xllcorner 0.0                 or xllcenter, half a cell further east; yllcorner, yllcenter alike;
//     yllcorner 0.0                 or ulxmap and ulymap, the north-western cell's centre (as GDAL writes)
//     cellsize 1.0                  or xdim and ydim
//     NODATA_value -9999            or nodata; may be left out
//     byteorder LSBFIRST            or I: little-endian (default); MSBFIRST or M: big-endian
//     nbits 32, pixeltype FLOAT, nbands 1, layout BIL may stand there, with no other value; skipbytes,
//     bandgapbytes, bandrowbytes and totalrowbytes only as a plain file has them.
// The data: nrows * ncols floats without gaps, row 1 is the north. Cell centres are the knots.
// `gdal_translate -of EHdr -ot Float32 IN OUT.flt` writes one.
//
// No data: the NODATA value, NaN, infinities, and everything from 1e30 on (writers round -3.4e38 each in
// their way). What such knots get is the surface's policy (terrain/tiled_bspline.h).
//
// Rows are read one by one (pread) out of the system's page cache, not through a memory map: a tile touches
// 124 rows, each on pages of its own, and a page fault costs four times such a read (0.13 against 0.55 ms a
// tile, measured). Nor do the pages count as this process's memory then, nor does a file that shrinks under
// us end the process.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::map {

enum class ByteOrder { kLittleEndian, kBigEndian };

struct FltHeader {
  terrain::GridFrame frame;
  ByteOrder byte_order = ByteOrder::kLittleEndian;
  float no_data = -9999.0f;  ///< NaN when the header names none
};

/// The header's text; `source` names it in errors. Errors: a key missing, twice, or out of range.
core::Expected<FltHeader> parse_flt_header(std::string_view text, const std::string& source);

/// An open grid: immutable, any thread may read. Heights that can't be read any more (the disk fails, the
/// file was cut) count as without data; read_failures() says whether that happened.
class FltGrid final : public terrain::HeightSource {
 public:
  /// `file` is the .flt; its header is the .hdr beside it. Errors: no such files, a bad header, a size that
  /// isn't 4 nrows ncols.
  static core::Expected<std::shared_ptr<const FltGrid>> open(const std::filesystem::path& file);
  ~FltGrid() override;
  FltGrid(const FltGrid&) = delete;
  FltGrid& operator=(const FltGrid&) = delete;

  [[nodiscard]] terrain::GridFrame frame() const override { return header_.frame; }
  void read(std::size_t column, std::size_t row, std::span<double> out) const override;
  [[nodiscard]] std::uint64_t read_failures() const override {
    return read_failures_.load(std::memory_order_relaxed);
  }

 private:
  FltGrid(const FltHeader& header, int descriptor) : header_(header), descriptor_(descriptor) {}

  FltHeader header_;
  int descriptor_;  ///< owned
  mutable std::atomic<std::uint64_t> read_failures_{0};
};

}  // namespace woodlouse::map
