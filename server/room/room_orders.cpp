// What an operator asks of a room.
#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/access/bans.h"
#include "server/room/room.h"
#include "shared/protocol/codes.h"
#include "shared/replay/line_writer.h"

namespace woodlouse::server {

namespace asio = boost::asio;

/// On the strand, of a room that has begun and not stopped.
template <typename Order>
void Room::order(Ordered answered, Order carry_out) {
  assert(answered);
  asio::post(strand_, [self = shared_from_this(), this, answered = std::move(answered),
                       carry_out = std::move(carry_out)]() mutable {
    if (state_ == State::kWaiting || state_ == State::kStopped)
      return answered(core::fail({}, "the room has stopped"));
    carry_out(std::move(answered));
  });
}

void Room::ask_roster(std::function<void(std::vector<RosterEntry>)> answered) {
  assert(answered);
  asio::post(strand_, [self = shared_from_this(), this, answered = std::move(answered)] {
    answered(members_.roster(timekeeper_.now()));
  });
}

void Room::say(const protocol::Notice& notice) {
  asio::post(strand_, [self = shared_from_this(), this, notice] { members_.say(notice); });
}

void Room::say_from_now_on(const protocol::Notice& notice) {
  asio::post(strand_, [self = shared_from_this(), this, notice] { members_.say_from_now_on(notice); });
}

void Room::put_out(std::vector<RosterEntry> entries, std::function<void(std::vector<SessionId>)> put_out) {
  assert(put_out);
  asio::post(strand_,
             [self = shared_from_this(), this, entries = std::move(entries), put_out = std::move(put_out)] {
               std::vector<SessionId> here;
               for (const RosterEntry& entry : entries)
                 if (const SessionId session = members_.put_out(entry)) here.push_back(session);
               put_out(std::move(here));
             });
}

void Room::mute(const RosterEntry& whom, std::optional<Duration> lasts) {
  asio::post(strand_, [self = shared_from_this(), this, whom, lasts] {
    const auto seconds = lasts ? std::chrono::ceil<std::chrono::seconds>(*lasts).count() : 0;
    const auto ends = static_cast<std::uint64_t>(wall_now().time_since_epoch().count() + seconds);
    members_.mute(whom, lasts ? timekeeper_.now() + *lasts : Time::max(), lasts ? ends : kMutedForGood);
  });
}

void Room::unmute(const RosterEntry& whom) {
  asio::post(strand_, [self = shared_from_this(), this, whom] { members_.mute(whom, Time{}, 0); });
}

void Room::pause(Ordered answered) {
  order(std::move(answered), [this](const Ordered& done) {
    if (state_ == State::kPaused) return done(core::fail({}, "is paused already"));
    if (steps_left_ == 0) members_.pause();
    say(LogEvent::kRoomPaused, fmt::format("paused at tick {}", game_->tick()));
    steps_left_ = 0;
    end_steps(core::fail({}, "was paused before all steps were done"));
    stand_still();
    done(game_->tick());
  });
}

void Room::hold(std::function<void()> held) {
  assert(held);
  asio::post(strand_, [self = shared_from_this(), this, held = std::move(held)] {
    is_held_ = true;
    if (state_ == State::kRunning || state_ == State::kAsleep) stand_still();
    held();
  });
}

void Room::resume(Ordered answered) {
  order(std::move(answered), [this](const Ordered& done) {
    const bool steps = std::exchange(steps_left_, 0) != 0;
    if (state_ != State::kPaused && !steps) return done(core::fail({}, "is not paused"));
    say(LogEvent::kRoomResumed, fmt::format("goes on with tick {}", game_->tick()));
    end_steps(core::fail({}, "was resumed before all steps were done"));
    members_.resume();
    if (unshown_) members_.await_keeping();
    if (!steps) go_on();
    done(game_->tick());
  });
}

void Room::step(std::uint64_t ticks, Ordered answered) {
  assert(ticks >= 1);
  order(std::move(answered), [this, ticks](Ordered done) {
    if (state_ != State::kPaused)
      return done(core::fail({}, steps_left_ != 0 ? "is still doing the steps before" : "is not paused"));
    members_.refill();
    steps_left_ = ticks;
    stepped_ = std::move(done);
    go_on();
  });
}

/// Nobody is told: not for each of the steps of one who looks at a game tick by tick.
void Room::stand_still() {
  if (state_ == State::kRunning)
    for (const auto& watcher : watchers_) watcher->fall_asleep(*game_);
  state_ = State::kPaused;
  if (unshown_) unshown_->is_over = true;
  next_tick_.expect_none();
  alarm_->cancel();
  if (!unshown_) members_.stand();
  post_figures();
  end_steps(game_->tick());
}

void Room::go_on() {
  assert(state_ == State::kPaused && clock_);
  state_ = State::kRunning;
  deserted_ticks_ = 0;
  post_figures();
  for (const auto& watcher : watchers_) watcher->wake(*game_);
  clock_->restart(std::chrono::ceil<std::chrono::milliseconds>(timekeeper_.now()));
  if (!unshown_) await_tick();
}

void Room::end_steps(core::Expected<std::uint64_t> tick) {
  if (stepped_) std::exchange(stepped_, nullptr)(std::move(tick));
}

void Room::ask_header(std::string_view build,
                      std::function<void(replay::Header header, std::uint64_t game)> answered) {
  assert(answered);
  asio::post(strand_,
             [self = shared_from_this(), this, build = std::string(build), answered = std::move(answered)] {
               answered(replay::make_header(*game_, build, map_file_), games_);
             });
}

void Room::record(std::unique_ptr<TickWatcher> recorder, std::uint64_t game, Ordered answered) {
  assert(recorder != nullptr);
  order(std::move(answered), [this, made = std::move(recorder), game](const Ordered& done) mutable {
    look_for_recording();
    if (is_recorded_) return done(core::fail({}, "is recorded already"));
    if (game != games_) return done(core::fail({}, "has begun another game meanwhile"));
    late_ = std::move(made);
    if (game_->state().roster.empty()) {
      begin_late();
      if (state_ != State::kRunning) watchers_.back()->fall_asleep(*game_);
    }
    look_for_recording();
    done(game_->tick());
  });
}

void Room::end_recording(const std::string& reason, Ordered answered) {
  order(std::move(answered), [this, reason](const Ordered& done) {
    if (std::exchange(late_, nullptr)) {
      look_for_recording();
      return done(game_->tick());
    }
    const auto found = std::find_if(watchers_.begin(), watchers_.end(),
                                    [](const auto& watcher) { return watcher->is_recording(); });
    if (found == watchers_.end()) return done(core::fail({}, "is not recorded"));
    Watchers ended;
    ended.push_back(std::move(*found));
    watchers_.erase(found);
    look_for_recording();
    const auto former = former_.insert(former_.end(), {nullptr, std::move(ended)});
    finish(former->watchers, reason, [this, former] {
      for (const auto& watcher : former->watchers) watcher->add_figures(working_);
      former_.erase(former);
      end_if_finished();
    });
    done(game_->tick());
  });
}

void Room::begin_late() {
  assert(late_ != nullptr);
  attach(*late_);
  late_->begin(*game_);
  watchers_.push_back(std::move(late_));
}

void Room::look_for_recording() {
  is_recorded_ = late_ != nullptr || std::any_of(watchers_.begin(), watchers_.end(),
                                                 [](const auto& watcher) { return watcher->is_recording(); });
}

// ---- its members ---------------------------------------------------------------------------------------

void Members::on_message(Seat& seat, const SessionOccupant& occupant, const protocol::Chat& chat,
                         Time arrived) {
  if (seat.muted_until > arrived) {
    const auto left = std::chrono::ceil<std::chrono::seconds>(seat.muted_until - arrived).count();
    const std::string span =
        seat.muted_until == Time::max() ? "as long as you are here" : fmt::format("for another {} s", left);
    return occupant.subscriber->answer(protocol::ErrorMessage{
        std::string(protocol::code::kMuted), "chat: you have been muted " + span, false, {}});
  }
  if (refuse_when_busy(seat, Spending::kChat, arrived)) return;
  for (const auto& watcher : watchers_) watcher->chat(game_->tick(), seat.louse, seat.name, chat.text);
  send(events_.chat(game_->tick(), seat, chat.text));
}

void Members::say(const protocol::Notice& notice) {
  seats_.for_each<SessionOccupant>(
      [&](const Seat&, const SessionOccupant& occupant) { occupant.subscriber->answer(notice); });
}

void Members::say_from_now_on(const protocol::Notice& notice) {
  std::erase_if(standing_, [&](const protocol::Notice& one) { return one.code == notice.code; });
  standing_.push_back(notice);
  say(notice);
}

void Members::refuse_held(Subscriber& subscriber) {
  constexpr std::uint32_t kAgainMs = 50;
  subscriber.refuse_join({std::string(protocol::code::kMoved),
                          "join: the room is about to go on at another server: join again", false, kAgainMs});
}

/// Whoever joins later hears what holds then: nothing that is over, nor that it is.
void Members::announce(const protocol::Notice& notice) {
  const bool is_end = notice.code == protocol::code::kDurable || notice.code == protocol::code::kResumed;
  const std::string_view over =
      notice.code == protocol::code::kDurable ? protocol::code::kNotDurable : protocol::code::kPaused;
  if (is_end)
    std::erase_if(notices_, [over](const protocol::Notice& told) { return told.code == over; });
  else
    notices_.push_back(notice);
  if (is_paused_ && notice.code == protocol::code::kResumed) return;  // the operator's pause holds
  seats_.for_each<SessionOccupant>(
      [&](const Seat&, const SessionOccupant& occupant) { occupant.subscriber->answer(notice); });
}

void Members::pause() {
  is_paused_ = true;
  may_wait_ = kMostPaused;
  say_from_now_on(
      {std::string(protocol::code::kPaused), "the operator has paused this room: it stands still"});
}

void Members::resume() {
  is_paused_ = false;
  may_wait_.reset();
  std::erase_if(standing_,
                [](const protocol::Notice& notice) { return notice.code == protocol::code::kPaused; });
  const bool stands_still = std::any_of(notices_.begin(), notices_.end(), [](const protocol::Notice& told) {
    return told.code == protocol::code::kPaused;
  });
  if (!stands_still) say({std::string(protocol::code::kResumed), "the room goes on"});
}

SessionId Members::put_out(const RosterEntry& whom) {
  Seat* seat = seats_.find(whom);
  if (seat == nullptr) return 0;
  seats_.forget_token(*seat);
  if (const auto* session = std::get_if<SessionOccupant>(&seat->occupant)) return session->session;
  if (!std::holds_alternative<BotOccupant>(seat->occupant)) end(seats_.take_away(*seat));
  return 0;
}

}  // namespace woodlouse::server
