// The encoders of a room's row layouts: one frame, or one sheet, per layout and tick, however many want it.
// Pure. One owner, no locking.
#pragma once

#include <boost/container/small_vector.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "server/frames/frame_encoder.h"
#include "server/frames/layouts.h"
#include "server/frames/sheet_encoder.h"

namespace woodlouse::server {

struct ChannelFrame {
  ChannelId channel = 0;
  Frame frame;
};

/// Of one tick. Few rooms have more layouts than find place without memory of their own.
using ChannelFrames = boost::container::small_vector<ChannelFrame, 4>;

class Channels {
 public:
  /// REQUIRES that it is not open.
  void open(ChannelId channel, RowLayout layout);
  void close(ChannelId channel);
  /// Those that are open stay so, and what they have shown is forgotten: another game's ticks follow.
  void begin_anew();

  /// The last key, and the last delta on it: where a newcomer or a resync begins. Encodes a key if there is
  /// none. REQUIRES that it is open.
  std::vector<Frame> newest(ChannelId channel, const Scene& scene);
  /// The frame of every layout for this scene; a layout without a key gets one.
  ChannelFrames encode(const Scene& scene, FrameKind kind);

  /// Frames encoded so far.
  [[nodiscard]] std::uint64_t encoded() const { return encoded_; }

 private:
  struct Channel {
    std::variant<FrameEncoder, SheetEncoder> encoder;
    std::optional<Frame> key, delta;
  };
  const Frame& encode(Channel& channel, const Scene& scene, FrameKind kind);

  std::map<ChannelId, Channel> channels_;
  std::uint64_t encoded_ = 0;
};

}  // namespace woodlouse::server
