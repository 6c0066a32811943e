#include "server/relay/relay_room.h"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <utility>
#include <variant>

#include "shared/core/joined.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
namespace code = protocol::code;

/// The number behind that beginning of a line, whose rest is read by who re-runs it; nothing: another one.
std::optional<std::uint64_t> number_behind(std::string_view line, std::string_view beginning) {
  if (!line.starts_with(beginning)) return std::nullopt;
  line.remove_prefix(beginning.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

std::optional<std::uint64_t> step_of(std::string_view line) { return number_behind(line, R"({"step":)"); }
std::optional<std::uint64_t> keyframe_of(std::string_view line) {
  return number_behind(line, R"({"keyframe":)");
}

/// The tick to which a line of steps leads.
std::uint64_t end_of(std::string_view line, std::uint64_t step) {
  constexpr std::string_view kSteps = R"("steps":)";
  const std::size_t at = line.find(kSteps);
  const auto steps = at == std::string_view::npos ? std::nullopt : number_behind(line.substr(at), kSteps);
  const std::uint64_t count =
      std::clamp<std::uint64_t>(steps.value_or(1), 1, replay::kMaxStepsBetweenKeyframes);
  return step > UINT64_MAX - count ? UINT64_MAX : step + count;
}

protocol::ErrorMessage error(std::string_view code, std::string text) {
  return {std::string(code), std::move(text), false, {}};
}

Seat seat_of(match::PlayerId louse, const match::PlayerLabel& label) {
  return {louse, label.name, label.role, 0, Nobody{}};
}

}  // namespace

/// Holds the room weakly, as its sessions are held by the room.
class RelayRoom::RelayDoor final : public Door {
 public:
  explicit RelayDoor(const std::shared_ptr<RelayRoom>& room) : room_(room), name_(room->name()) {}

  void join(Arrival arrival) override {
    if (const auto room = room_.lock()) return room->join(std::move(arrival));
    arrival.subscriber->refuse_join(error(code::kShutdown, "join: the room has closed"));
  }
  void vacate(SessionId) override {}
  void submit(SessionId session, protocol::ClientMessage message, Time) override {
    if (const auto room = room_.lock()) room->submit(session, std::move(message));
  }
  void leave(SessionId session, Parting) override {
    if (const auto room = room_.lock()) room->leave(session);
  }
  [[nodiscard]] bool only_shows() const override { return true; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] protocol::RoomEntry census() const override {
    if (const auto room = room_.lock()) return room->census();
    return {name_, {}, 0, 0, 0};
  }

 private:
  std::weak_ptr<RelayRoom> room_;
  std::string name_;
};

std::shared_ptr<Door> RelayRoom::door() { return std::make_shared<RelayDoor>(shared_from_this()); }

RelayRoom::RelayRoom(asio::io_context& ticks, const Lanes& lanes, RoomSettings settings,
                     const LiveLimits& limits, Duration delay, Timekeeper& timekeeper, replay::Maps& maps,
                     Hooks hooks)
    : settings_(std::move(settings)),
      limits_(limits),
      delay_(delay),
      strand_(asio::make_strand(ticks)),
      timekeeper_(timekeeper),
      hooks_(std::move(hooks)),
      alarm_(timekeeper.make_alarm(strand_)),
      follower_("the log", this, &maps),
      outlet_(std::make_shared<Outlet>(lanes)) {
  assert(!settings_.name.empty() && settings_.state_hz >= 1 && hooks_.ready && hooks_.lost);
}

// ---- what the log tells --------------------------------------------------------------------------------

void RelayRoom::take(std::vector<std::string> lines) {
  asio::post(strand_,
             [self = shared_from_this(), this, lines = std::move(lines), at = timekeeper_.now()]() mutable {
               if (is_over_) return;
               std::uint64_t end = 0;
               for (std::string& line : lines) {
                 if (const auto step = step_of(line)) end = std::max(end, end_of(line, *step));
                 lines_.push_back(std::move(line));
               }
               if (playout_ && end != 0) playout_->came(end, at);
               if (!is_playing_) play();
             });
}

/// What is due is re-run, in slices; then the next step's time is waited for.
void RelayRoom::play() {
  is_playing_ = false;
  const Time until = timekeeper_.now() + kSlice;
  while (!lines_.empty() && !is_over_) {
    const Time now = timekeeper_.now();
    const auto step = step_of(lines_.front());
    const bool is_shown_already = step && display_ && *step < shown_;
    if (step && playout_ && !is_shown_already && lines_.size() <= kMostWaiting)
      if (const Time due = playout_->due(*step); due > now) return ring(due);
    const std::string line = std::move(lines_.front());
    lines_.pop_front();
    rerun(line);
    if (timekeeper_.now() < until) continue;
    is_playing_ = true;
    return asio::post(strand_, [self = shared_from_this()] { self->play(); });
  }
  if (display_ && !is_over_ && !stands_) ring(timekeeper_.now() + kStandsAfter);
}

/// Weakly: the room owns the alarm.
void RelayRoom::ring(Time when) {
  alarm_->set(when, [room = weak_from_this()](bool cancelled) {
    const auto self = room.lock();
    if (!self || cancelled || self->is_over_ || self->is_playing_) return;
    if (!self->lines_.empty()) return self->play();
    if (!std::exchange(self->stands_, true)) self->display_->stand(self->seats_);
  });
}

/// A header is read with the keyframe behind it: between the two there would be no game to be shown.
void RelayRoom::rerun(const std::string& line) {
  if (line.starts_with(R"({"format":)")) {
    is_header_new_ = is_header_new_ || line != header_;
    header_ = line;
    return;
  }
  const match::Match* game = follower_.match();
  if (const auto tick = keyframe_of(line)) {
    if (header_.empty() || (game != nullptr && !is_header_new_ && *tick <= game->tick())) return;
    if (std::exchange(is_header_new_, false) && !follower_.take(header_))
      return lose(follower_.difference()->what);
  } else if (game == nullptr || is_header_new_) {
    return;  // of a game whose beginning is still to come
  } else if (const auto step = step_of(line); step && end_of(line, *step) <= game->tick()) {
    return;  // told again
  }
  if (!follower_.take(line)) return lose(follower_.difference()->what);
  proven_ = follower_.proven();
}

void RelayRoom::began(const match::Match& game) {
  const match::MatchSettings former_game = std::exchange(game_, game.settings());
  const auto former_map = std::exchange(map_, game.shared_map());
  const match::PlayerLabels former_who = std::exchange(who_, game.labels());
  const bool is_first = !display_;
  if (is_first) {
    settings_.state_hz = granted_state_hz(settings_.state_hz, game_.tick_hz);
    display_.emplace(settings_, game, *outlet_);
    playout_.emplace(game_.tick_hz, delay_);
  } else if (former_game.tick_hz != game_.tick_hz) {
    return lose("the room goes on at another tick rate");
  } else if (former_map->hash == map_->hash && former_game.mode == game_.mode && game.tick() >= shown_) {
    display_->go_on(game);
    for (const auto& [louse, label] : former_who)
      if (!who_.contains(louse)) send(events_.left(game.tick(), seat_of(louse, label)));
  } else {
    display_->begin(game, seats_, company());
  }
  if (former_map != nullptr && former_map != map_) outlet_->keep(former_map);
  shown_ = game.tick();
  count();
  if (is_first) hooks_.ready();
}

void RelayRoom::stepped(const match::StepRecord& step, const match::Match& game) {
  assert(display_ && game.tick() == step.tick + 1);
  stands_ = false;
  shown_ = game.tick();
  for (const match::RosterChange& change : step.roster) tell(change, step.tick);
  display_->show_step(LiveStep(step, {}));
  for (const rules::Event& event : step.events) {
    const auto label = game.labels().find(event.louse);
    send(events_.ruled(event, label != game.labels().end() ? label->second.name : std::string(),
                       *game.rules()));
  }
  display_->send_frames(seats_);
  if (!step.roster.empty()) {
    who_ = game.labels();
    count();
  }
}

void RelayRoom::tell(const match::RosterChange& change, std::uint64_t tick) {
  const auto known = who_.find(change.player);
  const match::PlayerLabel& label = known != who_.end() ? known->second : change.label;
  const Seat seat = seat_of(change.player, label);
  switch (change.action) {
    case match::RosterAction::kJoin:
      return send(events_.joined(tick, seat));
    case match::RosterAction::kLeave:
      return send(events_.left(tick, seat));
    case match::RosterAction::kRespawn:
    case match::RosterAction::kRespawnAtGate:
      return send(events_.respawned(tick, seat));
  }
}

void RelayRoom::said(const replay::ChatLine& chat) {
  const auto known = who_.find(chat.player);
  const auto role = known != who_.end() ? known->second.role : protocol::Role::kSpectator;
  send(events_.chat(shown_, seat_of(chat.player, {chat.name, role}), chat.text));
}

/// The log is read anew by who comes next, from its newest keyframe on.
void RelayRoom::lose(const std::string& why) {
  if (std::exchange(is_over_, true)) return;
  lines_.clear();
  alarm_->cancel();
  dismiss({std::string(code::kShutdown), "what is shown here can't be proven any more: come back", true, {}});
  hooks_.lost(why);
}

void RelayRoom::close(const protocol::Bye& bye) {
  asio::post(strand_, [self = shared_from_this(), this, bye] {
    if (std::exchange(is_over_, true)) return;
    lines_.clear();
    alarm_->cancel();
    dismiss(bye);
  });
}

// ---- who watches ---------------------------------------------------------------------------------------

void RelayRoom::dismiss(const protocol::Bye& bye) {
  for (const Seat& seat : seats_.take_away_sessions()) {
    const auto& occupant = std::get<SessionOccupant>(seat.occupant);
    outlet_->remove(occupant.session, occupant.subscriber->lane());
    occupant.subscriber->end(bye);
  }
  places_ = {};
  spectators_ = 0;
}

Company RelayRoom::company() const {
  Company company;
  for (const auto& [louse, label] : who_) company.players.push_back({louse, label.name, label.role});
  company.spectators = spectators_.load();
  return company;
}

void RelayRoom::count() {
  const auto of = [this](protocol::Role role) {
    return static_cast<std::uint32_t>(std::count_if(
        who_.begin(), who_.end(), [role](const auto& entry) { return entry.second.role == role; }));
  };
  players_ = of(protocol::Role::kPlayer);
  bots_ = of(protocol::Role::kBot);
  const std::lock_guard lock(mutex_);
  map_name_ = map_->definition.name;
}

protocol::RoomEntry RelayRoom::census() const {
  const std::lock_guard lock(mutex_);
  return {settings_.name, map_name_, players_.load(), bots_.load(), spectators_.load()};
}

void RelayRoom::join(Arrival arrival) {
  assert(arrival.subscriber != nullptr);
  asio::post(strand_, [self = shared_from_this(), arrival = std::move(arrival)]() mutable {
    self->admit(std::move(arrival));
  });
}

std::optional<protocol::ErrorMessage> RelayRoom::why_not(const Arrival& arrival) const {
  assert(arrival.join.role == protocol::Role::kSpectator);
  if (arrival.unless_back) return arrival.unless_back;
  if (is_over_ || !display_) return error(code::kShutdown, "join: the room has closed");
  const auto limits = limits_.now();
  if (!places_.has_one(arrival.join.role, arrival.address, *limits))
    return error(
        code::kRoomFull,
        core::joined({"join: room ", settings_.name, " has no place for another spectator here (",
                      std::to_string(limits->max_spectators), "); try again later or another server"}));
  if (arrival.join.stream == protocol::Stream::kInputs && !display_->has_inputs())
    return error(code::kBadField, core::joined({"join.stream: the map of room ", settings_.name,
                                                " is too big to be watched by inputs; watch by frames"}));
  return std::nullopt;
}

void RelayRoom::admit(Arrival arrival) {
  if (auto refusal = why_not(arrival)) return arrival.subscriber->refuse_join(std::move(*refusal));
  settings_.limits = *limits_.now();
  Seat seat{0, seats_.free_name(arrival.join.name, arrival.session), protocol::Role::kSpectator, 0,
            SessionOccupant{arrival.session, arrival.subscriber, 0}};
  seat.address = arrival.address;
  places_.take(seat.role, seat.address);
  ++spectators_;
  display_->welcome(seat, arrival, false, company());
  display_->subscribe(std::get<SessionOccupant>(seat.occupant), events_.next());
  seats_.add(std::move(seat));
}

void RelayRoom::submit(SessionId session, protocol::ClientMessage message) {
  asio::post(strand_, [self = shared_from_this(), session, message = std::move(message)] {
    self->take_from(session, message);
  });
}

void RelayRoom::take_from(SessionId session, const protocol::ClientMessage& message) {
  const Seat* seat = seats_.find(session);
  if (seat == nullptr) return;  // refused, or it has left since
  const auto& occupant = std::get<SessionOccupant>(seat->occupant);
  if (std::holds_alternative<protocol::Leave>(message))
    return outlet_->let_go(session, occupant.subscriber->lane());
  if (std::holds_alternative<protocol::GetMap>(message)) return display_->show_map(occupant);
  if (std::holds_alternative<protocol::Resync>(message)) return display_->show_newest(occupant);
  if (const auto* look = std::get_if<protocol::Look>(&message)) return display_->look(session, look->view);
  if (std::holds_alternative<protocol::ListRecords>(message) ||
      std::holds_alternative<protocol::GetGhost>(message))
    return occupant.subscriber->answer(error(code::kNoRecords, "records are kept where the room is played"));
  occupant.subscriber->answer(
      error(code::kOnlyShown, "the room is played at another server and only shown here: nothing was done"));
}

void RelayRoom::leave(SessionId session) {
  asio::post(strand_, [self = shared_from_this(), this, session] {
    const auto seat = seats_.take_away(session);
    if (!seat) return;
    display_->unsubscribe(std::get<SessionOccupant>(seat->occupant));
    places_.give_back(seat->role, seat->address);
    --spectators_;
  });
}

}  // namespace woodlouse::server
