#include "server/room/room.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

#include "shared/protocol/codes.h"

namespace woodlouse::server {

namespace asio = boost::asio;

/// Rooms tick from whole milliseconds on, so that of many some tick together: to wake for each of them alone
/// costs the system as much as a small room's step.
using Beat = std::chrono::milliseconds;

/// Holds the room weakly: a session that has not heard of its closing keeps none of it.
class Room::RoomDoor final : public Door {
 public:
  explicit RoomDoor(const std::shared_ptr<Room>& room)
      : room_(room), name_(room->name()), map_(room->census().map) {}

  void join(Arrival arrival) override {
    if (const auto room = room_.lock()) return room->join(std::move(arrival));
    Members::refuse_closed(*arrival.subscriber);
  }
  void vacate(SessionId session) override {
    if (const auto room = room_.lock()) room->vacate(session);
  }
  void submit(SessionId session, protocol::ClientMessage message, Time arrived) override {
    if (const auto room = room_.lock()) room->submit(session, std::move(message), arrived);
  }
  void leave(SessionId session, Parting parting) override {
    if (const auto room = room_.lock()) room->leave(session, parting);
  }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] protocol::RoomEntry census() const override {
    if (const auto room = room_.lock()) return room->census();
    return {name_, map_, 0, 0, 0};
  }

 private:
  std::weak_ptr<Room> room_;
  std::string name_;
  std::string map_;
};

std::shared_ptr<Room> Room::make(asio::io_context& ticks, const Lanes& lanes, RoomSettings settings,
                                 Start start, Watchers watchers, Timekeeper& timekeeper,
                                 std::shared_ptr<spdlog::logger> log, Rotation* rotation) {
  return std::shared_ptr<Room>(new Room(ticks, lanes, std::move(settings), std::move(start),
                                        std::move(watchers), timekeeper, std::move(log), rotation));
}

Room::Room(asio::io_context& ticks, const Lanes& lanes, RoomSettings settings, Start start, Watchers watchers,
           Timekeeper& timekeeper, std::shared_ptr<spdlog::logger> log, Rotation* rotation)
    : settings_(std::move(settings)),
      log_(std::move(log)),
      strand_(asio::make_strand(ticks)),
      timekeeper_(timekeeper),
      alarm_(timekeeper.make_alarm(strand_)),
      rotation_(rotation),
      game_(std::move(start.match)),
      team_(std::move(start.team)),
      watchers_(std::move(watchers)),
      members_(lanes, settings_, *game_, watchers_, std::move(start.unclaimed), timekeeper.now(), log_),
      map_file_(std::move(start.map_file)),
      next_tick_(game_->settings().tick_hz) {
  assert(game_ != nullptr && (rotation_ == nullptr) == (settings_.rounds_a_game == 0));
}

std::shared_ptr<Door> Room::door() { return std::make_shared<RoomDoor>(shared_from_this()); }

void Room::start(std::function<void()> ended) {
  asio::post(strand_, [self = shared_from_this(), this, ended = std::move(ended)]() mutable {
    if (state_ != State::kWaiting) return;
    ended_ = std::move(ended);
    state_ = State::kRunning;
    begin_watching();
    for (const auto& watcher : watchers_) members_.tell_claims(*watcher);
    look_for_recording();
    members_.add_house_bots(std::move(team_));
    if (settings_.ends_unclaimed) members_.end_unclaimed();
    clock_.emplace(game_->settings().tick_hz, std::chrono::ceil<Beat>(timekeeper_.now()));
    await_tick();
  });
}

void Room::attach(TickWatcher& watcher) {
  // What a former game's watchers still say is nothing to those who play this one.
  watcher.attach([room = weak_from_this(), number = games_](const protocol::Notice& notice) {
    const auto self = room.lock();
    if (!self) return;
    asio::post(self->strand_, [self, notice, number] {
      if (self->games_ == number) self->members_.announce(notice);
    });
  });
  watcher.attach_events([room = weak_from_this(), number = games_](const protocol::Event& event) {
    const auto self = room.lock();
    if (!self) return;
    asio::post(self->strand_, [self, event, number] {
      if (self->games_ == number) self->members_.tell(event);
    });
  });
}

void Room::begin_watching() {
  for (const auto& watcher : watchers_) attach(*watcher);
  for (const auto& watcher : watchers_) watcher->begin(*game_);
}

void Room::stop(const protocol::Bye& bye, const std::string& reason, std::function<void()> stopped) {
  asio::post(strand_, [self = shared_from_this(), this, bye, reason, stopped = std::move(stopped)]() mutable {
    if (has_ended_) return stopped();
    const bool is_first = awaiting_end_.empty();
    awaiting_end_.push_back(std::move(stopped));
    if (!is_first) return;
    const bool was_watched = state_ != State::kWaiting;
    state_ = State::kStopped;
    unshown_.reset();
    next_tick_.expect_none();
    alarm_->cancel();
    end_steps(core::fail({}, "the room has closed"));
    members_.dismiss(bye);
    post_figures();  // should the watchers take too long for whoever waits
    const auto finished = [this] {
      has_finished_ = true;
      end_if_finished();
    };
    if (!was_watched) return finished();
    finish(watchers_, reason, finished);
  });
}

/// All at once: a shadow that is behind must not keep the recording from its end.
void Room::finish(const Watchers& watchers, const std::string& reason, std::function<void()> finished) {
  auto parts = std::make_shared<std::atomic<std::size_t>>(1 + watchers.size());
  const auto part_done = [self = shared_from_this(), parts, finished = std::move(finished)] {
    if (parts->fetch_sub(1) == 1) asio::post(self->strand_, [self, finished] { finished(); });
  };
  for (const auto& watcher : watchers) watcher->finish(reason, part_done);
  part_done();
}

void Room::end_if_finished() {
  if (!has_finished_ || !former_.empty()) return;
  assert(!has_ended_ && state_ == State::kStopped);
  has_ended_ = true;
  post_figures();
  for (const auto& stopped : std::exchange(awaiting_end_, {})) stopped();
}

/// Now, or, while a join of that session waits, behind it.
template <typename Job>
void Room::in_order(SessionId session, Job job) {
  if (at_the_door_.jobs_of.empty() || !at_the_door_.jobs_of.contains(session)) return job();
  at_the_door_.push(session, std::move(job));
}

void Room::join(Arrival arrival) {
  assert(arrival.subscriber != nullptr);
  asio::post(strand_, [self = shared_from_this(), this, arrival = std::move(arrival)]() mutable {
    const SessionId session = arrival.session;
    at_the_door_.push(session, [this, arrival = std::move(arrival)]() mutable { admit(std::move(arrival)); });
    if (at_the_door_.jobs.size() == 1) serve_the_door();
  });
}

void Room::serve_the_door() {
  const Time until = timekeeper_.now() + kDoorSlice;
  while (!at_the_door_.jobs.empty()) {
    at_the_door_.pop()();
    if (timekeeper_.now() < until || at_the_door_.jobs.empty()) continue;
    return asio::post(strand_, [self = shared_from_this(), this] { serve_the_door(); });
  }
}

void Room::admit(Arrival arrival) {
  if (state_ == State::kStopped) return Members::refuse_closed(*arrival.subscriber);
  if (is_held_) return Members::refuse_held(*arrival.subscriber);
  members_.admit(std::move(arrival));
  if (state_ == State::kAsleep) wake();
}

void Room::submit(SessionId session, protocol::ClientMessage message, Time arrived) {
  asio::post(strand_, [self = shared_from_this(), this, session, message = std::move(message), arrived] {
    in_order(session, [this, session, message, arrived] { members_.take(session, message, arrived); });
  });
}

void Room::vacate(SessionId session) {
  asio::post(strand_, [self = shared_from_this(), this, session] {
    in_order(session, [this, session] { members_.vacate(session); });
  });
}

void Room::leave(SessionId session, Parting parting) {
  asio::post(strand_, [self = shared_from_this(), this, session, parting] {
    in_order(session, [this, session, parting] { members_.remove(session, parting); });
  });
}

void Room::await_tick() {
  next_tick_.expect(clock_->deadline());
  // Weakly: the room owns the alarm.
  alarm_->set(clock_->deadline(), [room = weak_from_this()](bool cancelled) {
    const auto self = room.lock();
    if (!self || cancelled || self->state_ != State::kRunning) return;
    // One that was due when the room was paused may still ring once it goes on.
    if (self->timekeeper_.now() >= self->clock_->deadline()) self->on_tick_due();
  });
}

void Room::on_tick_due() {
  assert(!unshown_);
  const Time now = timekeeper_.now();
  const std::uint64_t moves = clock_->moves();
  const Duration late = clock_->begin(now);
  working_.lateness.add(late);
  if (clock_->moves() != moves)
    say(LogEvent::kClockMoved,
        fmt::format("tick {} came {} ms late; the clock moved, nothing is made up for", game_->tick(),
                    std::chrono::duration_cast<std::chrono::milliseconds>(late).count()));
  tick(now);
  unshown_->work = timekeeper_.now() - now;
  if (!is_to_be_kept()) return end_tick();
  next_tick_.expect_none();
  members_.await_keeping();
}

/// Asks a watcher to keep what the tick has played; whether the tick ends once that is done.
bool Room::is_to_be_kept() {
  const auto kept = [room = weak_from_this(), number = unshown_->number, game = games_] {
    const auto self = room.lock();
    if (!self) return;
    asio::post(self->strand_, [self, number, game] {
      const bool waits = self->unshown_ && self->unshown_->number == number && self->games_ == game;
      if (waits) self->end_tick();
    });
  };
  return std::any_of(watchers_.begin(), watchers_.end(),
                     [&kept](const auto& watcher) { return watcher->await_kept(kept); });
}

void Room::end_tick() {
  const Time begun = timekeeper_.now();
  show();
  working_.work.add(unshown_->work + (timekeeper_.now() - begun));
  const bool is_over = unshown_->is_over;
  unshown_.reset();
  members_.end_keeping();
  ++working_.ticks;
  if (working_.ticks % game_->settings().tick_hz == 0) post_figures();
  if (state_ != State::kRunning) return members_.stand();
  if (is_over) return await_tick();
  if (settings_.tick_limit && former_ticks_ + game_->tick() >= *settings_.tick_limit) {
    state_ = State::kStopped;
    next_tick_.expect_none();
    return ended_();
  }
  if (is_game_over() && is_next_ready()) begin_next();
  if (steps_left_ != 0) {
    if (--steps_left_ == 0) return stand_still();
  } else if (is_to_sleep()) {
    return fall_asleep();
  }
  // Of a long wait nothing is made up for.
  if (begun > clock_->deadline() + TickClock::kMaxLateTicks * clock_->period())
    clock_->restart(std::chrono::ceil<Beat>(begun));
  await_tick();
}

/// A room that is to end by itself goes on.
bool Room::is_to_sleep() {
  deserted_ticks_ = members_.is_deserted() ? deserted_ticks_ + 1 : 0;
  const std::uint64_t most = static_cast<std::uint64_t>(kSleepAfter.count()) * game_->settings().tick_hz;
  return !settings_.tick_limit && deserted_ticks_ >= most;
}

void Room::fall_asleep() {
  assert(state_ == State::kRunning);
  state_ = State::kAsleep;
  next_tick_.expect_none();
  ++working_.sleeps;
  post_figures();
  say(LogEvent::kRoomAsleep,
      fmt::format("nobody is here: it stands still at tick {} until somebody joins", game_->tick()));
  for (const auto& watcher : watchers_) watcher->fall_asleep(*game_);
}

void Room::wake() {
  assert(state_ == State::kAsleep);
  state_ = State::kRunning;
  deserted_ticks_ = 0;
  post_figures();
  say(LogEvent::kRoomAwake, fmt::format("goes on with tick {}", game_->tick()));
  for (const auto& watcher : watchers_) watcher->wake(*game_);
  clock_->restart(std::chrono::floor<Beat>(timekeeper_.now()));  // who has joined waits for none
  await_tick();
}

void Room::tick(Time now) {
  const std::uint64_t number = game_->tick();
  members_.give_up_vacant();
  members_.steer_house_bots();
  const match::StepRecord& record = game_->advance();
  unshown_.emplace(number, now, record, members_.margins(number, now));
  for (const auto& watcher : watchers_) watcher->step(unshown_->step, *game_);
  if (late_) begin_late();
}

/// What the tick did, to who is here.
void Room::show() {
  assert(unshown_);
  members_.answer(unshown_->number, unshown_->due);
  members_.tell(unshown_->step);
  if (std::all_of(watchers_.begin(), watchers_.end(),
                  [](const auto& watcher) { return watcher->may_show(); }))
    members_.send_frames();
  for (const auto& watcher : watchers_) watcher->rest(*game_);
}

void Room::post_figures() {
  look_for_recording();
  working_.asleep = state_ == State::kAsleep || state_ == State::kPaused;
  working_.frames_encoded = members_.frames_encoded();
  if (clock_) working_.clock_moves = clock_->moves();
  RoomFigures all = working_;
  for (const FormerGame& former : former_)
    for (const auto& watcher : former.watchers) watcher->add_figures(all);
  for (const auto& watcher : watchers_) watcher->add_figures(all);
  figures_.post(std::move(all));
}

}  // namespace woodlouse::server
