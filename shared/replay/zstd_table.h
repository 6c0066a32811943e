// The table of frames at the end of a compressed recording, as zstd's seekable format has it (zstd sources,
// contrib/seekable_format): a skippable frame with the packed and unpacked size of each frame.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "shared/replay/zstd_input.h"

namespace woodlouse::replay {

/// What a frame takes, packed and unpacked.
struct ZstdFrameSize {
  std::uint32_t packed = 0;
  std::uint32_t unpacked = 0;
};

struct ZstdTable {
  std::vector<ZstdFrame> frames;
  std::uint64_t unpacked = 0;  ///< bytes altogether
};

void append_zstd_table(std::string& out, const std::vector<ZstdFrameSize>& frames);

/// Nothing when the stream does not end with one that fits its length; moves the stream.
std::optional<ZstdTable> read_zstd_table(std::istream& packed);

}  // namespace woodlouse::replay
