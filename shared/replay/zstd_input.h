// Reads a recording of zstd frames as the text it was: a stream buffer that seeks by the unpacked byte.
//
// Frames are independent. A finished recording ends with a table of them, in zstd's own seekable format (a
// skippable frame, which zstd passes over); where it is missing, or names other frames than there are
// (zstd_table.h), they are found by unpacking the file once. What the table says a frame unpacks to is
// compared whenever the end of one is reached, however it is read: whoever reads all of it without a fault
// has read what any jump finds. A file that was cut off gives what its last frame holds. Bombs are refused: a
// window past kMaxWindow, a frame that unpacks to more than kMaxFrameBytes, more than kMaxRatio bytes of text
// for each byte of the file.
#pragma once

#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shared/replay/byte_stream.h"

namespace woodlouse::replay {

/// Where a frame begins, packed and unpacked.
struct ZstdFrame {
  std::uint64_t packed = 0;
  std::uint64_t unpacked = 0;
};

class ZstdInput : public FaultTellingBuffer {
 public:
  static constexpr int kMaxWindowLog = 23;                                  ///< 8 MiB
  static constexpr std::uint64_t kMaxFrameBytes = std::uint64_t{64} << 20;  ///< unpacked

  static constexpr std::uint64_t kMaxRatio =
      100;  ///< but for kMaxFrameBytes; a step's hash alone keeps it below 10

  static constexpr std::size_t kBufferBytes = 1u << 17;  ///< of a file

  /// buffer_bytes: of what is read at once, and of what is unpacked at once; not 0.
  explicit ZstdInput(std::unique_ptr<InputStream> packed, std::size_t buffer_bytes = kBufferBytes);

  [[nodiscard]] bool is_cut_off() const override { return is_drained_ && is_frame_open_; }

 protected:
  int_type underflow() override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode which) override;

 private:
  struct Release {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };

  [[nodiscard]] std::uint64_t position() const;
  bool refill_packed();
  bool unpack_some();
  bool check_frame_end();
  void restart(const ZstdFrame& frame);
  void find_frames();

  std::unique_ptr<InputStream> packed_;
  std::unique_ptr<ZSTD_DCtx, Release> context_;
  std::vector<char> in_;
  std::vector<char> out_;
  ZSTD_inBuffer pending_{};         ///< of in_, not yet unpacked
  std::uint64_t packed_read_ = 0;   ///< bytes of the file before pending_'s end
  std::uint64_t unpacked_end_ = 0;  ///< bytes before egptr()
  ZstdFrame frame_;                 ///< being read
  bool is_frame_open_ = false;
  bool is_drained_ = false;        ///< the file was cut off within a frame, all of which is unpacked
  std::vector<ZstdFrame> frames_;  ///< by offset; the table's, or those to begin at that were met so far
  std::uint64_t total_ = 0;        ///< bytes unpacked; once known
  bool has_table_ = false;
  bool has_frames_ = false;  ///< frames_ and total_ are known to the end
};

}  // namespace woodlouse::replay
