#include "server/room/room.h"

#include <boost/asio/post.hpp>

#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "server/room/room_map.h"
#include "server/room/version.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {

namespace asio = boost::asio;

Room::Room(asio::io_context& ticks, asio::io_context& io, RoomSettings settings, Opening opening,
           RoomStaff staff, std::shared_ptr<spdlog::logger> log)
    : settings_(std::move(settings)),
      log_(std::move(log)),
      strand_(asio::make_strand(ticks)),
      timer_(strand_),
      recorder_(std::move(staff.recorder)),
      shadow_(std::move(staff.shadow)),
      broadcaster_(io),
      map_line_(encode_map_line(*opening.map)),
      match_owner_(std::move(opening.match)),
      tick_hz_(match_.settings().tick_hz),
      map_file_(std::move(opening.map_file)),
      parent_(std::move(opening.parent)),
      ahead_(std::move(staff.ahead)) {
  roster_.orphans = std::move(opening.orphans);
}

void Room::start(std::function<void()> ended) {
  asio::post(strand_, [this, ended = std::move(ended)]() mutable {
    ended_ = std::move(ended);
    state_ = State::kRunning;
    if (recorder_) begin_recording();
    if (shadow_) shadow_->begin(match_, map_file_);
    add_house_bots();
    clock_.emplace(tick_hz_, Clock::now());
    arm_timer();
  });
}

void Room::stop(const protocol::Bye& bye, const std::string& reason, std::function<void()> stopped) {
  asio::post(strand_, [this, bye, reason, stopped = std::move(stopped)]() mutable {
    state_ = State::kStopped;
    timer_.cancel();
    for (auto& [session, member] : roster_.members) {
      broadcaster_.remove(session);
      member.subscriber->end(bye);
    }
    roster_.members.clear();
    metrics_.frames_encoded = channels_.encoded();
    if (clock_) metrics_.clock_moves = clock_->moves();
    if (ahead_) metrics_.ground = ahead_->metrics();
    finish_staff(reason, std::move(stopped));
  });
}

/// Both at once: a shadow that is behind must not keep the recording from its end.
void Room::finish_staff(const std::string& reason, std::function<void()> stopped) {
  auto parts = std::make_shared<std::atomic<int>>(1 + (recorder_ ? 1 : 0) + (shadow_ ? 1 : 0));
  const auto part_done = [parts, stopped = std::move(stopped)] {
    if (parts->fetch_sub(1) == 1) stopped();
  };
  if (recorder_) recorder_->finish(reason, part_done);
  if (shadow_)
    shadow_->finish([this, part_done] {
      metrics_.shadow = shadow_->metrics();
      part_done();
    });
  part_done();
}

void Room::join(SessionId session, std::shared_ptr<Subscriber> subscriber, protocol::Join join) {
  asio::post(strand_, [this, session, subscriber = std::move(subscriber), join = std::move(join)]() mutable {
    admit(session, std::move(subscriber), join);
  });
}

void Room::leave(SessionId session) {
  asio::post(strand_, [this, session] { remove(session); });
}

protocol::RoomEntry Room::census() const {
  return {settings_.name, match_.map().definition.name, players_.load(), bots_.load(), spectators_.load()};
}

void Room::count(protocol::Role role, std::int32_t change) {
  auto& counter = role == protocol::Role::kPlayer ? players_
                  : role == protocol::Role::kBot  ? bots_
                                                  : spectators_;
  counter.fetch_add(static_cast<std::uint32_t>(change));
}

Scene Room::scene() const {
  const std::uint64_t frame_ticks = tick_hz_ / settings_.state_hz;
  return {match_.tick(),         match_.tick() / frame_ticks,
          match_.world().lice(), match_.world().terrain(),
          match_.hash(),         match_.link()};
}

void Room::arm_timer() {
  timer_.expires_at(clock_->deadline());
  timer_.async_wait([this](const boost::system::error_code& error) { on_timer(error); });
}

void Room::on_timer(const boost::system::error_code& error) {
  if (error || state_ != State::kRunning) return;
  const Time now = Clock::now();
  const std::uint64_t moves = clock_->moves();
  const Duration late = clock_->begin(now);
  metrics_.lateness.add(late);
  if (clock_->moves() != moves)
    log_->warn("room {}: tick {} came {} ms late; the clock moved, nothing is made up for", settings_.name,
               match_.tick(), std::chrono::duration_cast<std::chrono::milliseconds>(late).count());
  tick(now);
  metrics_.work.add(Clock::now() - now);
  ++metrics_.ticks;
  if (settings_.tick_limit && match_.tick() >= *settings_.tick_limit) {
    state_ = State::kStopped;
    return ended_();
  }
  arm_timer();
}

void Room::tick(Time now) {
  const std::uint64_t number = match_.tick();
  steer_house_bots();
  const match::StepRecord& step = match_.advance();
  const std::vector<PendingAck> acks = acks_.take(number);
  if (recorder_) record_step(step, now, acks);
  if (shadow_) shadow_->step(step, match_);
  send_acks(number, now, acks);
  if (match_.tick() % (tick_hz_ / settings_.state_hz) == 0) send_frames();
  if (ahead_) look_ahead();
}

void Room::look_ahead() {
  ahead_->look(match_.world().lice());
  if (match_.tick() % tick_hz_ != 0 || metrics_.ground) return;  // once a second, until it was told
  const GroundMetrics ground = ahead_->metrics();
  if (ground.read_failures == 0) return;
  metrics_.ground = ground;
  log_->error(
      "room {}: the map's file can't be read any more ({} reads failed; {}). Where it could not, ground "
      "without data "
      "stands in: the game goes on, its recording may not verify. Check the disk, and that nobody changed "
      "the file",
      settings_.name, ground.read_failures, map_file_);
}

void Room::begin_recording() {
  recorder_->on_failure([this](const std::string& why) {
    asio::post(strand_, [this, why] {
      for (auto& [session, member] : roster_.members)
        member.subscriber->answer(protocol::Notice{std::string(protocol::code::kRecordingEnded),
                                                   "the game is no longer recorded: " + why});
    });
  });
  for (const Orphan& orphan : roster_.orphans) recorder_->player(orphan.louse, orphan.name, orphan.role);
  replay::Header header = replay::make_header(match_, kServerName, map_file_);
  header.parent = parent_;
  recorder_->begin(header, match_.state());
}

void Room::add_house_bots() {
  for (std::uint32_t number = 0; number < settings_.bots; ++number) {
    HouseMember member{HouseBot(number, match_.settings().seed), 0, 0};
    const std::optional<Orphan> taken = roster_.take_over(member.bot.name());
    member.louse = taken ? taken->louse : match_.join();
    member.seq = taken ? taken->first_seq : 0;
    if (recorder_) recorder_->player(member.louse, member.bot.name(), protocol::Role::kBot);
    roster_.house.push_back(std::move(member));
    count(protocol::Role::kBot, +1);
  }
}

void Room::steer_house_bots() {
  const std::uint64_t period = std::max(1u, tick_hz_ / HouseBot::kDecisionsPerSecond);
  for (HouseMember& member : roster_.house) {
    // Spread over the period, so that no tick pays for all of them.
    if ((match_.tick() + member.louse) % period != 0) continue;
    const state::Louse* louse = match_.world().find(member.louse);
    if (!louse) continue;
    const auto& world = match_.world();
    const state::Thrust thrust = member.bot.decide({*louse, world.terrain(), world.parameters()});
    match_.file({member.louse, ++member.seq, thrust, state::kHeld, 0});
  }
}

void Room::record_step(const match::StepRecord& step, Time begun, const std::vector<PendingAck>& acks) {
  using std::chrono::microseconds;
  std::vector<InputMargin> margins;
  margins.reserve(acks.size());
  for (const PendingAck& ack : acks) {
    const auto late = static_cast<std::int64_t>(ack.ticks_late * 1'000'000 / tick_hz_);
    const std::int64_t margin = std::chrono::duration_cast<microseconds>(begun - ack.arrived).count() - late;
    margins.push_back({ack.player, ack.seq, margin});
  }
  recorder_->step(step, std::move(margins), match_);
}

void Room::send_acks(std::uint64_t tick, Time begun, const std::vector<PendingAck>& acks) {
  for (const PendingAck& pending : acks) {
    Member* member = roster_.find(pending.session);
    if (!member) continue;
    protocol::Ack ack;
    ack.seq = pending.seq - member->first_seq;
    ack.tick = tick;
    ack.margin_us = std::chrono::duration_cast<std::chrono::microseconds>(begun - pending.arrived).count();
    ack.late = pending.late;
    ack.clamped = pending.clamped;
    if (const state::Louse* louse = match_.world().find(pending.player))
      ack.you = protocol::ExactState{match_.tick(), *louse};
    member->subscriber->answer(ack);
  }
}

void Room::send_frames() {
  if (channels_.empty()) return;
  const Scene now = scene();
  const FrameKind kind = now.index % settings_.state_hz == 0 ? FrameKind::kKey : FrameKind::kDelta;
  broadcaster_.frames(kind, channels_.encode(now, kind));
}

}  // namespace woodlouse::server
