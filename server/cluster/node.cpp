#include "server/cluster/node.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace woodlouse::server {
Node::Node(ClusterSettings settings, Viewers viewers, std::shared_ptr<spdlog::logger> log)
    : settings_(std::move(settings)),
      viewers_(std::move(viewers)),
      log_(std::move(log)),
      table_({}, settings_.shard, process_) {  // nobody's beat is its own
  assert(viewers_->lines && viewers_->closed);
}

Node::Node(ClusterSettings settings, Hooks hooks, std::shared_ptr<spdlog::logger> log)
    : settings_(std::move(settings)),
      hooks_(std::move(hooks)),
      log_(std::move(log)),
      table_(settings_.host, settings_.shard, process_) {
  assert(!settings_.host.empty() && hooks_.take_over && hooks_.step_down && hooks_.census && hooks_.move);
  beat_.host = settings_.host;
  beat_.address = settings_.address;
  beat_.shard = settings_.shard;
  beat_.process = process_;
}

core::Expected<void> Node::connect() {
  if (auto opened = open_log_link(); !opened) return opened;
  if (auto opened = open_beat_link(); !opened) return opened;
  if (const auto state = log_link_->stream_state(); !state)
    return core::fail(state.error().where, "has no such stream: " + state.error().what,
                      "make it, once:  woodlouse-server cluster init FILE");
  return {};
}

core::Expected<void> Node::open_log_link() {
  auto link =
      NatsLink::open(settings_, "log",
                     {[inbox = inbox_](std::uint64_t sequence) { inbox->put(Acknowledged{sequence}); },
                      [inbox = inbox_](std::string why) { inbox->put(Refused{std::move(why)}); },
                      [this](bool is_connected) { is_log_cut_ = !is_connected; },
                      [this] { is_log_cut_ = is_log_closed_ = true; }});
  if (!link) return tl::unexpected(link.error());
  log_link_ = std::move(*link);
  is_log_cut_ = is_log_closed_ = false;
  return {};
}

core::Expected<void> Node::open_beat_link() {
  auto link = NatsLink::open(settings_, "beats",
                             {{},
                              {},
                              [this](bool is_connected) { is_beat_cut_ = !is_connected; },
                              [this] { is_beat_cut_ = is_beat_closed_ = true; }});
  if (!link) return tl::unexpected(link.error());
  beat_link_ = std::move(*link);
  is_beat_cut_ = is_beat_closed_ = false;
  if (auto heard = hear_beats(); !heard || viewers_) return heard;
  return hear_operators();
}

/// libnats gives a line up for good where it is refused twice, as while a certificate is changed: another one
/// is made then. True: the log's is another one.
bool Node::renew_links() {
  constexpr Duration kEvery = std::chrono::seconds(1);
  const bool is_beat = viewers_ && is_beat_closed_;  // a host's other thread has it
  if ((!is_log_closed_ && !is_beat) || Clock::now() < renew_at_) return false;
  renew_at_ = Clock::now() + kEvery;
  if (is_beat)
    if (const auto opened = open_beat_link(); !opened) complain(opened.error());
  if (!is_log_closed_) return false;
  const auto opened = open_log_link();
  if (!opened) return complain(opened.error());
  say(LogEvent::kClusterFollows, "NATS takes this host again");
  return true;
}

core::Expected<void> Node::hear_beats() {
  return beat_link_->subscribe(settings_.beat_subject("*"),
                               [this](const auto&, const std::string& bytes, auto) {
                                 auto beat = beat_from(bytes);
                                 if (!beat) return;
                                 const bool goes = beat->leaves;
                                 table_.take(std::move(*beat), Clock::now());
                                 if (goes) inbox_->put(Nudge{});  // whose rooms wait
                               });
}

/// What else could be said there is nothing to this host.
core::Expected<void> Node::hear_operators() {
  return beat_link_->subscribe(settings_.move_subject(), [this](const auto&, const std::string& bytes, auto) {
    const auto order = move_order_from(bytes);
    if (!order) return;
    const bool is_meant = order->from == settings_.host;
    if (is_meant) is_drained_ = true;
    bool owns = false;
    {
      const std::lock_guard lock(mutex_);
      owns = beat_.owns;
    }
    if (owns && !is_leaving_ && (is_meant || order->from.empty())) hooks_.move(order->to);
  });
}

void Node::start() {
  assert(log_link_ && beat_link_);
  running_ = std::jthread([this] { run(); });
  if (!viewers_) beating_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
}

void Node::begin_leaving(const std::string& to) {
  is_leaving_ = true;
  const auto next = table_.successor(Clock::now(), to);
  const std::lock_guard lock(mutex_);
  beat_.to = next ? next->host : to;     // one alone, or all who stand by would try
  if (!beat_.owns) beat_.leaves = true;  // an owner only once all is stored
}

void Node::hand_over() {
  assert(is_leaving_);
  is_to_hand_over_ = true;
  inbox_->put(Nudge{});
}

void Node::leave() {
  inbox_->stop();
  if (running_.joinable()) running_.join();
  beating_.request_stop();
  if (beating_.joinable()) beating_.join();
  log_link_.reset();
  beat_link_.reset();
}

std::unique_ptr<TickWatcher> Node::watch(const std::string& room, replay::Header header) {
  return std::make_unique<LogTap>(inbox_, room, std::move(header), settings_.silence / 2,
                                  settings_.is_strict);
}

std::optional<std::string> Node::elsewhere(std::string_view room) const {
  // One that is silent may be gone: who asks is better told to ask again.
  constexpr Duration kHeardWithin = 6 * kBeatEvery;
  const auto owner = table_.owner(Clock::now(), kHeardWithin);
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
  std::vector<HostedRoom> rooms = table_.rooms(Clock::now());
  const std::lock_guard lock(mutex_);
  if (beat_.owns)
    std::erase_if(rooms, [this](const HostedRoom& one) { return one.shard == settings_.shard; });
  return rooms;
}

ClusterFigures Node::figures() const {
  const Time now = Clock::now();
  ClusterFigures figures = told_.figures(table_.hosts(now), now);
  figures.shard = settings_.shard;
  figures.connected = !is_cut_off();
  return figures;
}

std::vector<std::string> Node::hosts() const {
  constexpr std::size_t kMost = 16;
  return table_.addresses(Clock::now(), kMost);
}

void Node::run() {
  while (!inbox_->is_stopping()) {
    if (!follow()) return;
    own();
  }
}

void Node::beat_soon() {
  const std::lock_guard lock(mutex_);
  is_beat_due_ = true;
  beat_now_.notify_all();
}

// ---- signs of life -------------------------------------------------------------------------------------

void Node::beat(const std::stop_token& stop) {
  constexpr Duration kRoomsEvery = std::chrono::seconds(1);
  constexpr Duration kRoomsOpen = std::chrono::seconds(3);  // of an owner that begins
  std::optional<Time> owns_since;
  Time rooms_at{};
  const auto tell = [&] {
    Beat beat;
    {
      const std::lock_guard lock(mutex_);
      beat = beat_;
    }
    const Time now = Clock::now();
    owns_since = beat.owns ? owns_since.value_or(now) : std::optional<Time>();
    if (beat.owns && (now >= rooms_at || now - *owns_since < kRoomsOpen)) {
      rooms_at = now + kRoomsEvery;
      beat.rooms = hooks_.census();
      if (beat.rooms->size() > kMostRoomsOfShard) beat.rooms->resize(kMostRoomsOfShard);
    }
    // What is lost of it is told again.
    static_cast<void>(beat_link_->publish(settings_.beat_subject(settings_.host), to_text(beat)));
  };
  Time next = Clock::now();
  Time renew_at{};
  while (!stop.stop_requested()) {
    if (is_beat_closed_ && Clock::now() >= renew_at) {
      renew_at = Clock::now() + std::chrono::seconds(1);
      static_cast<void>(open_beat_link());  // the other thread says why not
    }
    tell();
    next = std::max(next + kBeatEvery, Clock::now());
    std::unique_lock lock(mutex_);
    if (beat_now_.wait_until(lock, stop, next, [this] { return is_beat_due_; })) next = Clock::now();
    is_beat_due_ = false;
  }
  tell();
}

}  // namespace woodlouse::server
