// The row layouts in use in a room, each with its encoder: one frame per layout and tick, whoever many want
// it. Pure. The room's strand owns it.
#pragma once

#include <boost/container/small_vector.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "server/room/frame_encoder.h"

namespace woodlouse::server {

using ChannelId = std::uint32_t;

struct ChannelFrame {
  ChannelId channel = 0;
  Frame frame;
};

/// Of one tick. Few rooms have more layouts than find place without memory of their own.
using ChannelFrames = boost::container::small_vector<ChannelFrame, 4>;

class Channels {
 public:
  /// In a room at a time, besides the common ones, which everybody can have; bounds the
  /// encoding of a tick.
  static constexpr std::size_t kMaxRareLayouts = 32;

  /// One more client of that layout; where there are kMaxRareLayouts others, of the smallest one in use that
  /// has its columns, or of every column.
  ChannelId acquire(const RowLayout& layout);
  /// REQUIRES an acquired channel.
  [[nodiscard]] const RowLayout& layout(ChannelId channel) const {
    return channels_.at(channel).encoder.layout();
  }
  /// One client less.
  void release(ChannelId channel);

  /// The last key, and the last delta on it: where a newcomer or a resync begins. Encodes a key if there is
  /// none.
  std::vector<Frame> newest(ChannelId channel, const Scene& scene);
  /// The frame of every layout for this scene; a layout without a key gets one.
  ChannelFrames encode(const Scene& scene, FrameKind kind);

  [[nodiscard]] bool empty() const { return channels_.empty(); }
  /// Frames encoded so far.
  [[nodiscard]] std::uint64_t encoded() const { return encoded_; }

 private:
  struct Channel {
    FrameEncoder encoder;
    std::size_t users = 0;
    std::optional<Frame> key;
    std::optional<Frame> delta;
  };
  [[nodiscard]] RowLayout wider(const RowLayout& layout) const;
  const Frame& encode(Channel& channel, const Scene& scene, FrameKind kind);

  std::map<ChannelId, Channel> channels_;
  ChannelId next_id_ = 1;
  std::size_t rare_ = 0;  ///< of channels_, those that only some may have
  std::uint64_t encoded_ = 0;
};

}  // namespace woodlouse::server
