#include "server/room/channels.h"

#include <algorithm>
#include <cassert>

namespace woodlouse::server {

std::optional<ChannelId> Channels::acquire(const RowLayout& layout) {
  const auto same = [&layout](const auto& entry) { return entry.second.encoder.layout() == layout; };
  auto found = std::find_if(channels_.begin(), channels_.end(), same);
  if (found == channels_.end()) {
    if (channels_.size() >= kMaxLayouts) return std::nullopt;
    found = channels_.emplace(next_id_++, Channel{FrameEncoder(layout), 0, {}, {}}).first;
  }
  ++found->second.users;
  return found->first;
}

void Channels::release(ChannelId channel) {
  const auto found = channels_.find(channel);
  assert(found != channels_.end());
  if (--found->second.users == 0) channels_.erase(found);
}

const Frame& Channels::encode(Channel& channel, const Scene& scene, FrameKind kind) {
  ++encoded_;
  if (kind == FrameKind::kKey || !channel.key) {
    channel.key = channel.encoder.key(scene);
    channel.delta.reset();
    return *channel.key;
  }
  channel.delta = channel.encoder.delta(scene);
  return *channel.delta;
}

std::vector<Frame> Channels::newest(ChannelId id, const Scene& scene) {
  Channel& channel = channels_.at(id);
  if (!channel.key) encode(channel, scene, FrameKind::kKey);
  std::vector<Frame> frames{*channel.key};
  if (channel.delta) frames.push_back(*channel.delta);
  return frames;
}

ChannelFrames Channels::encode(const Scene& scene, FrameKind kind) {
  ChannelFrames frames;
  frames.reserve(channels_.size());
  for (auto& [id, channel] : channels_) frames.push_back({id, encode(channel, scene, kind)});
  return frames;
}

}  // namespace woodlouse::server
