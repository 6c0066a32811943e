// Packs a recording's text into zstd frames while it grows: what was flushed can be unpacked even if nothing
// more comes, each frame without the others, and all of them by zstdcat.
#pragma once

#include <zstd.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/replay/zstd_table.h"

namespace woodlouse::replay {

class FramePacker {
 public:
  static constexpr int kLevel = 9;       ///< about a hundredth of a core for a hundred bots
  static constexpr int kWholeLevel = 3;  ///< of whole_frame()
  static constexpr int kWindowLog = 20;  ///< 1 MiB: more than five seconds of text

  /// A frame of text that is all there: its tables are no larger than it needs, which for some thousand bytes
  /// is most of the work.
  [[nodiscard]] static std::string whole_frame(std::string_view text);

  FramePacker();

  /// All of these append the packed bytes that are ready to `out`.
  void append(std::string& out, std::string_view text);
  /// What was appended so far is in `out` afterwards.
  void flush(std::string& out);
  /// Ends the frame, if one is open; what follows begins another.
  void end_frame(std::string& out);
  /// Ends the last frame and adds the table of them all.
  void finish(std::string& out);

 private:
  struct Release {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };
  using Context = std::unique_ptr<ZSTD_CCtx, Release>;
  static Context make_context(int level);
  void pack(std::string& out, std::string_view text, ZSTD_EndDirective directive);

  Context context_;
  std::vector<char> buffer_;
  std::vector<ZstdFrameSize> frames_;
  ZstdFrameSize frame_;  ///< so far
};

}  // namespace woodlouse::replay
