// ESRI float grids (.flt + .hdr): heights as raw 32-bit floats, for maps too big to load.
//
//     ncols 10001                   header keys in any case and order, beside the data as NAME.hdr
//     nrows 10001
//     xllcorner 0.0                 or xllcenter, half a cell further east; yllcorner, yllcenter alike;
//     yllcorner 0.0                 or ulxmap and ulymap, the north-western cell's centre (as GDAL writes)
//     cellsize 1.0                  or xdim and ydim
//     NODATA_value -9999            or nodata; left out: the customary marks (elevation/ground.h) are none
//     byteorder LSBFIRST            or I: little-endian (default); MSBFIRST or M: big-endian
//     nbits 32, pixeltype FLOAT, nbands 1, layout BIL may stand there, with no other value; skipbytes,
//     bandgapbytes, bandrowbytes and totalrowbytes only as a plain file has them.
// The data: nrows * ncols floats without gaps, row 1 is the north. Cell centres are the knots.
// `gdal_translate -of EHdr -ot Float32 IN OUT.flt` writes one.
//
// No data: the NODATA value, NaN, infinities, and everything from 1e30 on (writers round -3.4e38 each in
// their way). What such knots get is the surface's policy (terrain/tiled_bspline.h).
#pragma once

#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::map {

/// Heights from here on are no data.
inline constexpr float kNoFloatHeightFrom = 1e30f;

enum class ByteOrder { kLittleEndian, kBigEndian };

struct FltHeader {
  terrain::GridFrame frame;
  ByteOrder byte_order = ByteOrder::kLittleEndian;
  float no_data = -9999.0f;      ///< NaN when the header names none
  bool declares_no_data = true;  ///< false: what is customarily none has to be taken for it
};

/// The header's text; `source` names it in errors. Errors: a key missing, twice, or out of range.
core::Expected<FltHeader> parse_flt_header(std::string_view text, const std::string& source);

}  // namespace woodlouse::map
