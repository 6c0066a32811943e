#include "server/cluster/node.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace woodlouse::server {

Node::Node(ClusterSettings settings, Viewers viewers, std::shared_ptr<spdlog::logger> log)
    : settings_(std::move(settings)),
      viewers_(std::move(viewers)),
      log_(std::move(log)),
      heartbeat_(settings_, heard()) {
  assert(settings_.is_edge && viewers_->lines && viewers_->closed);
}

Node::Node(ClusterSettings settings, Hooks hooks, std::shared_ptr<spdlog::logger> log)
    : settings_(std::move(settings)),
      hooks_(std::move(hooks)),
      log_(std::move(log)),
      heartbeat_(settings_, heard()) {
  assert(!settings_.is_edge && hooks_.take_over && hooks_.step_down && hooks_.stands_by && hooks_.census &&
         hooks_.move);
}

Heartbeat::Hooks Node::heard() {
  return {hooks_.census, [this] { inbox_->put(Nudge{}); },  // whose rooms wait
          [this](const MoveOrder& order) { asked(order); }};
}

void Node::asked(const MoveOrder& order) {
  const bool is_meant = order.from == settings_.host;
  if (is_meant) is_drained_ = true;
  if (heartbeat_.owns() && !is_leaving_ && (is_meant || order.from.empty())) hooks_.move(order.to);
}

core::Expected<void> Node::connect() {
  if (auto opened = open_log_link(); !opened) return opened;
  if (auto opened = heartbeat_.connect(); !opened) return opened;
  if (const auto state = log_link_->stream_state(); !state)
    return core::fail(state.error().where, "has no such stream: " + state.error().what,
                      "make it, once:  woodlouse-server cluster init FILE");
  return {};
}

core::Expected<void> Node::open_log_link() {
  is_log_cut_ = is_log_closed_ = false;  // before it is told that it is
  auto link =
      NatsLink::open(settings_, "log",
                     {[inbox = inbox_](std::uint64_t sequence) { inbox->put(Acknowledged{sequence}); },
                      [inbox = inbox_](std::string why) { inbox->put(Refused{std::move(why)}); },
                      [this](bool is_connected) { is_log_cut_ = !is_connected; },
                      [this] { is_log_cut_ = is_log_closed_ = true; }});
  if (!link) {
    is_log_cut_ = is_log_closed_ = true;
    return tl::unexpected(link.error());
  }
  log_link_ = std::move(*link);
  return {};
}

/// libnats gives a line up for good where it is refused twice, as while a certificate is changed: another one
/// is made then. True: it is another one.
bool Node::renew_log_link() {
  constexpr Duration kEvery = std::chrono::seconds(1);
  if (!is_log_closed_ || Clock::now() < renew_at_) return false;
  renew_at_ = Clock::now() + kEvery;
  const auto opened = open_log_link();
  if (!opened) return complain(opened.error());
  say(LogEvent::kClusterFollows, "NATS takes this host again");
  return true;
}

void Node::start() {
  assert(log_link_ && !running_.joinable());
  running_ = std::jthread([this] { run(); });
  heartbeat_.start();
}

void Node::begin_leaving(const std::string& to) {
  is_leaving_ = true;
  const auto next = table().successor(Clock::now(), to);
  heartbeat_.tell([&](Beat& beat) {
    beat.to = next ? next->host : to;    // one alone, or all who stand by would try
    if (!beat.owns) beat.leaves = true;  // an owner only once all is stored
  });
}

void Node::hand_over() {
  assert(is_leaving_);
  is_to_hand_over_ = true;
  inbox_->put(Nudge{});
}

void Node::leave() {
  inbox_->stop();
  if (running_.joinable()) running_.join();
  heartbeat_.stop();
  log_link_.reset();
}

std::unique_ptr<TickWatcher> Node::watch(const std::string& room, replay::Header header) {
  return std::make_unique<LogTap>(inbox_, room, std::move(header), settings_.silence / 2,
                                  settings_.is_strict);
}

std::optional<std::string> Node::elsewhere(std::string_view room) const {
  // One that is silent may be gone: who asks is better told to ask again.
  constexpr Duration kHeardWithin = std::chrono::milliseconds(300);
  const auto owner = table().owner(Clock::now(), kHeardWithin);
  if (!owner || !owner->rooms) return std::nullopt;
  const auto& rooms = *owner->rooms;
  const bool is_there = std::any_of(rooms.begin(), rooms.end(),
                                    [room](const protocol::RoomEntry& entry) { return entry.name == room; });
  return is_there || (room.empty() && !rooms.empty()) ? std::optional(owner->address) : std::nullopt;
}

bool Node::is_on_its_way(std::string_view room) const {
  const std::lock_guard lock(mutex_);
  return std::find(known_rooms_.begin(), known_rooms_.end(), room) != known_rooms_.end() ||
         (room.empty() && !known_rooms_.empty());
}

std::vector<HostedRoom> Node::rooms_elsewhere() const {
  std::vector<HostedRoom> rooms = table().rooms(Clock::now());
  if (heartbeat_.owns())
    std::erase_if(rooms, [this](const HostedRoom& one) { return one.shard == settings_.shard; });
  return rooms;
}

ClusterFigures Node::figures() const {
  const Time now = Clock::now();
  ClusterFigures figures = told_.figures(table().hosts(now), now);
  figures.shard = settings_.shard;
  figures.connected = !is_cut_off();
  return figures;
}

std::vector<std::string> Node::hosts() const {
  constexpr std::size_t kFirstEdges = 12;
  const Time now = Clock::now();
  if (!viewers_) return table().addresses(now);
  // Who watches is to be at an edge; at last the hosts have the room, too.
  std::vector<std::string> found = table().edge_addresses(now);
  const std::vector<std::string> hosts = table().addresses(now);
  const std::size_t first = std::min(found.size(), kFirstEdges);
  found.insert(found.begin() + static_cast<std::ptrdiff_t>(first), hosts.begin(), hosts.end());
  return found;
}

void Node::run() {
  while (!inbox_->is_stopping()) {
    if (!follow()) return;
    own();
  }
}

}  // namespace woodlouse::server
