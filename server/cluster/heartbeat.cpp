#include "server/cluster/heartbeat.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/access/resume_token.h"

namespace woodlouse::server {
namespace {

std::uint64_t new_process() { return make_resume_token()[0]; }

}  // namespace

Heartbeat::Heartbeat(const ClusterSettings& settings, Hooks hooks)
    : settings_(settings),
      hooks_(std::move(hooks)),
      table_(settings.is_edge ? std::string() : settings.host, settings.shard, new_process()) {
  assert(hooks_.goes && (settings_.is_edge || (hooks_.census && hooks_.asked && !settings_.host.empty())));
  beat_.host = settings_.host;
  beat_.address = settings_.address;
  beat_.shard = settings_.shard;
  beat_.process = table_.process();
  beat_.strict = settings_.is_strict;
}

core::Expected<void> Heartbeat::connect() {
  link_.reset();                 // what a former one says from now on is nothing to this one
  is_cut_ = is_closed_ = false;  // before it is told that it is
  auto opened = open();
  if (!opened) is_cut_ = is_closed_ = true;  // also one that hears only some of what it is to hear
  return opened;
}

core::Expected<void> Heartbeat::open() {
  auto link = NatsLink::open(settings_, "beats",
                             {{},
                              {},
                              [this](bool is_connected) { is_cut_ = !is_connected; },
                              [this] { is_cut_ = is_closed_ = true; }});
  if (!link) return tl::unexpected(link.error());
  link_ = std::move(*link);
  for (const bool is_edge : {false, true}) {
    const std::string subject = is_edge ? settings_.edge_subject("*") : settings_.beat_subject("*");
    auto heard = link_->subscribe(
        subject, [this, is_edge](const auto&, const std::string& bytes, auto) { take(is_edge, bytes); });
    if (!heard) return heard;
  }
  if (settings_.is_edge) return {};
  return link_->subscribe(settings_.move_subject(), [this](const auto&, const std::string& bytes, auto) {
    // What else could be said there is nothing to this host.
    if (const auto order = move_order_from(bytes)) hooks_.asked(*order);
  });
}

void Heartbeat::take(bool is_edge, std::string_view bytes) {
  auto beat = beat_from(bytes);
  if (!beat) return;
  const bool goes = !is_edge && beat->leaves;
  const bool is_new = is_edge ? table_.take_edge(std::move(*beat), Clock::now())
                              : table_.take(std::move(*beat), Clock::now());
  if (goes) hooks_.goes();
  if (is_new && owns() && !is_new_heard_.exchange(true)) soon();  // who has just come knows of no room
}

void Heartbeat::start() {
  assert(link_ && !beating_.joinable());
  beating_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
}

void Heartbeat::stop() {
  beating_.request_stop();
  if (beating_.joinable()) beating_.join();
  link_.reset();
}

void Heartbeat::soon() {
  const std::lock_guard lock(mutex_);
  is_due_ = true;
  now_.notify_all();
}

void Heartbeat::tell_once() {
  Beat beat;
  tell([&beat](const Beat& told) { beat = told; });
  const Time now = Clock::now();
  owns_since_ = beat.owns ? owns_since_.value_or(now) : std::optional<Time>();
  const Duration age = now - rooms_at_;
  if (beat.owns &&
      (age >= kRoomsEvery || now - *owns_since_ < kRoomsOpen || (is_new_heard_ && age >= kRoomsApart))) {
    is_new_heard_ = false;
    rooms_at_ = now;
    beat.rooms = hooks_.census();
    if (beat.rooms->size() > kMostRoomsOfShard) beat.rooms->resize(kMostRoomsOfShard);
  }
  const std::string subject =
      settings_.is_edge ? settings_.edge_subject(settings_.host) : settings_.beat_subject(settings_.host);
  // What is lost of it is told again.
  if (link_) static_cast<void>(link_->publish(subject, to_text(beat)));
}

/// libnats gives a line up for good where it is refused twice, as while a certificate is changed: another one
/// is made then. Of why it is refused the log's own line tells.
void Heartbeat::beat(const std::stop_token& stop) {
  constexpr Duration kRenewEvery = std::chrono::seconds(1);
  const Duration apart = settings_.is_edge ? kEdgeEvery : every(settings_.silence);
  Time next = Clock::now();
  Time renew_at{};
  while (!stop.stop_requested()) {
    if (is_closed_ && Clock::now() >= renew_at) {
      renew_at = Clock::now() + kRenewEvery;
      static_cast<void>(connect());
    }
    tell_once();
    next = std::max(next + apart, Clock::now());
    std::unique_lock lock(mutex_);
    if (now_.wait_until(lock, stop, next, [this] { return is_due_; })) next = Clock::now();
    is_due_ = false;
  }
  tell_once();
}

}  // namespace woodlouse::server
