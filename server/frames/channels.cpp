#include "server/frames/channels.h"

#include <cassert>
#include <utility>

namespace woodlouse::server {

void Channels::open(ChannelId channel, RowLayout layout) {
  Channel made{FrameEncoder(layout), std::nullopt, std::nullopt};
  if (layout.in_sheets) made.encoder = SheetEncoder(std::move(layout));
  const auto [at, is_new] = channels_.emplace(channel, std::move(made));
  assert(is_new);
  static_cast<void>(at);
  static_cast<void>(is_new);
}

void Channels::close(ChannelId channel) {
  const std::size_t closed = channels_.erase(channel);
  assert(closed == 1);
  static_cast<void>(closed);
}

void Channels::begin_anew() {
  for (auto& [id, channel] : channels_) {
    channel.key.reset();
    channel.delta.reset();
  }
}

const Frame& Channels::encode(Channel& channel, const Scene& scene, FrameKind kind) {
  ++encoded_;
  if (kind == FrameKind::kKey || !channel.key) {
    channel.key = std::visit([&](auto& encoder) { return encoder.key(scene); }, channel.encoder);
    channel.delta.reset();
    return *channel.key;
  }
  channel.delta = std::visit([&](auto& encoder) { return encoder.delta(scene); }, channel.encoder);
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
