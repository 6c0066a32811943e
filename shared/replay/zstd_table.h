// The table of frames at the end of a compressed recording, as zstd's seekable format has it (zstd sources,
// contrib/seekable_format): a skippable frame with the packed and unpacked size of each frame.
//
// Whoever wrote the file wrote the table: a table counts only where the file is the frames it names, each
// from where the one before ends, and the table, and nothing else. The frames' own headers and those of their
// blocks say where each ends, so nothing is unpacked for it (RFC 8878, 3.1.1). What a frame unpacks to only
// unpacking can say: zstd_input.h does when it comes to the frame's end.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shared/replay/zstd_input.h"

#include "shared/replay/byte_stream.h"

namespace woodlouse::replay {

/// What a frame takes, packed and unpacked.
struct ZstdFrameSize {
  std::uint32_t packed = 0;
  std::uint32_t unpacked = 0;
};

struct ZstdTable {
  std::vector<ZstdFrame> frames;  ///< last the table itself: where the others end
};

void append_zstd_table(std::string& out, const std::vector<ZstdFrameSize>& frames);

/// Nothing when the stream does not end with one that names its frames; moves the stream.
std::optional<ZstdTable> read_zstd_table(InputStream& packed);

}  // namespace woodlouse::replay
