#include "server/room/channels.h"

#include <algorithm>
#include <cassert>

namespace woodlouse::server {

namespace {

const std::vector<protocol::Column>& every_column() {
  static const std::vector<protocol::Column> columns = [] {
    std::vector<protocol::Column> every;
    for (std::size_t k = 0; k < protocol::kColumnCount; ++k)
      every.push_back(static_cast<protocol::Column>(k));
    return every;
  }();
  return columns;
}

/// Common ones: the default, a louse's own fields, and all that there is.
bool is_rare(const RowLayout& layout) {
  return layout.fields != protocol::default_columns() && layout.fields != protocol::all_columns() &&
         layout.fields != every_column();
}

bool has_all(const RowLayout& layout, const std::vector<protocol::Column>& fields) {
  return std::all_of(fields.begin(), fields.end(), [&](protocol::Column field) {
    return std::find(layout.fields.begin(), layout.fields.end(), field) != layout.fields.end();
  });
}

}  // namespace

RowLayout Channels::wider(const RowLayout& layout) const {
  RowLayout best{protocol::all_columns(), layout.format};
  if (!has_all(best, layout.fields)) best.fields = every_column();
  for (const auto& [id, channel] : channels_) {
    const RowLayout& own = channel.encoder.layout();
    if (own.format == layout.format && own.fields.size() < best.fields.size() && has_all(own, layout.fields))
      best = own;
  }
  return best;
}

ChannelId Channels::acquire(const RowLayout& layout) {
  const auto same = [&layout](const auto& entry) { return entry.second.encoder.layout() == layout; };
  auto found = std::find_if(channels_.begin(), channels_.end(), same);
  if (found == channels_.end()) {
    if (is_rare(layout) && rare_ >= kMaxRareLayouts) return acquire(wider(layout));
    rare_ += is_rare(layout) ? 1 : 0;
    found = channels_.emplace(next_id_++, Channel{FrameEncoder(layout), 0, {}, {}}).first;
  }
  ++found->second.users;
  return found->first;
}

void Channels::release(ChannelId channel) {
  const auto found = channels_.find(channel);
  assert(found != channels_.end());
  if (--found->second.users > 0) return;
  rare_ -= is_rare(found->second.encoder.layout()) ? 1 : 0;
  channels_.erase(found);
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
