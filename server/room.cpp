#include "server/room.h"

#include <boost/asio/post.hpp>

#include <utility>

#include "server/room_map.h"
#include "server/version.h"

namespace woodlouse::server {

namespace asio = boost::asio;

Room::Room(asio::io_context& ticks, asio::io_context& io, RoomSettings settings,
           std::shared_ptr<const map::Map> map, std::unique_ptr<Recorder> recorder,
           std::shared_ptr<spdlog::logger> log)
    : settings_(std::move(settings)),
      log_(std::move(log)),
      strand_(asio::make_strand(ticks)),
      timer_(strand_),
      recorder_(std::move(recorder)),
      broadcaster_(io),
      map_line_(encode_map_line(*map)),
      match_(std::move(map), {settings_.tick_hz, settings_.seed}) {}

void Room::start(std::function<void()> ended) {
  asio::post(strand_, [this, ended = std::move(ended)]() mutable {
    ended_ = std::move(ended);
    state_ = State::kRunning;
    if (recorder_) recorder_->begin(replay::make_header(match_, kServerName, settings_.map_file));
    add_house_bots();
    clock_.emplace(settings_.tick_hz, Clock::now());
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
    if (recorder_) return recorder_->finish(match_.tick(), reason, std::move(stopped));
    stopped();
  });
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
  const std::uint64_t frame_ticks = settings_.tick_hz / settings_.state_hz;
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
  send_acks(number, now, acks);
  if (match_.tick() % (settings_.tick_hz / settings_.state_hz) == 0) send_frames();
}

void Room::add_house_bots() {
  for (std::uint32_t number = 0; number < settings_.bots; ++number) {
    HouseMember member{HouseBot(number, settings_.seed), match_.join(), 0};
    if (recorder_) recorder_->player(member.louse, member.bot.name(), protocol::Role::kBot);
    roster_.house.push_back(std::move(member));
    count(protocol::Role::kBot, +1);
  }
}

void Room::steer_house_bots() {
  const std::uint64_t period = std::max(1u, settings_.tick_hz / HouseBot::kDecisionsPerSecond);
  for (HouseMember& member : roster_.house) {
    // Spread over the period, so that no tick pays for all of them.
    if ((match_.tick() + member.louse) % period != 0) continue;
    const physics::Louse* louse = match_.world().find(member.louse);
    if (!louse) continue;
    const auto& world = match_.world();
    const physics::Thrust thrust = member.bot.decide({*louse, world.terrain(), world.parameters()});
    match_.file({member.louse, ++member.seq, thrust, physics::kHeld, 0});
  }
}

void Room::record_step(const match::StepRecord& step, Time begun, const std::vector<PendingAck>& acks) {
  std::vector<InputMargin> margins;
  margins.reserve(acks.size());
  for (const PendingAck& ack : acks)
    margins.push_back({ack.player, ack.seq,
                       std::chrono::duration_cast<std::chrono::microseconds>(begun - ack.arrived).count()});
  recorder_->step(step, std::move(margins), match_.world().lice());
}

void Room::send_acks(std::uint64_t tick, Time begun, const std::vector<PendingAck>& acks) {
  for (const PendingAck& pending : acks) {
    Member* member = roster_.find(pending.session);
    if (!member) continue;
    protocol::Ack ack;
    ack.seq = pending.seq;
    ack.tick = tick;
    ack.margin_us = std::chrono::duration_cast<std::chrono::microseconds>(begun - pending.arrived).count();
    ack.late = pending.late;
    ack.clamped = pending.clamped;
    if (const physics::Louse* louse = match_.world().find(pending.player))
      ack.you = protocol::ExactState{match_.tick(),
                                     louse->id,
                                     louse->position,
                                     louse->velocity,
                                     louse->heading,
                                     louse->thrust,
                                     static_cast<std::uint32_t>(louse->thrust_kind),
                                     louse->thrust_ticks,
                                     static_cast<std::uint32_t>(louse->phase),
                                     louse->flight_z,
                                     louse->flight_vz,
                                     louse->distance};
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
