#include "server/room/members.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <set>
#include <type_traits>
#include <utility>
#include <variant>

#include "server/logging/events.h"
#include "shared/core/joined.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace code = protocol::code;

protocol::ErrorMessage error(std::string_view code, std::string text,
                             std::optional<std::uint32_t> retry_after_ms = {}) {
  return {std::string(code), std::move(text), false, retry_after_ms};
}

}  // namespace

Members::Members(const Lanes& lanes, const RoomSettings& settings, match::Match& game,
                 const Watchers& watchers, std::vector<Seat> unclaimed, Time now,
                 std::shared_ptr<spdlog::logger> log)
    : settings_(settings),
      game_(&game),
      watchers_(watchers),
      log_(std::move(log)),
      outlet_(std::make_shared<Outlet>(lanes)),
      display_(settings, game, *outlet_),
      seats_(std::move(unclaimed)),
      budgets_(settings.limits, now) {
  inputs_.emplace(settings_, *game_, seats_);
  name_map();
  place_vacant();
}

void Members::name_map() {
  const std::lock_guard lock(map_name_mutex_);
  map_name_ = game_->map().definition.name;
}

// ---- who is here ---------------------------------------------------------------------------------------

protocol::RoomEntry Members::census() const {
  const std::lock_guard lock(map_name_mutex_);
  return {settings_.name, map_name_, players_.load(), bots_.load(), spectators_.load()};
}

void Members::count(protocol::Role role, std::int32_t change) {
  auto& counter = role == protocol::Role::kPlayer ? players_
                  : role == protocol::Role::kBot  ? bots_
                                                  : spectators_;
  counter.fetch_add(static_cast<std::uint32_t>(change));
}

void Members::give_louse(Seat& seat) {
  const bool is_session = std::holds_alternative<SessionOccupant>(seat.occupant);
  std::optional<Seat> taken;
  if (!is_session || settings_.adopts_by_name) taken = seats_.take_over(seat.name);
  if (taken) {
    seat.louse = taken->louse;
    seat.next_seq = taken->next_seq;
    seat.muted_until = std::max(seat.muted_until, taken->muted_until);
    seat.mute_ends = std::max(seat.mute_ends, taken->mute_ends);
    if (is_session)
      log_event(*log_, LogEvent::kLouseTakenOver,
                fmt::format("room {}: \"{}\" takes over louse {} of the recording", settings_.name, seat.name,
                            seat.louse));
    return;
  }
  seat.name = seats_.free_name(seat.name, static_cast<std::uint64_t>(events_.next()));
  seat.louse = game_->join({seat.name, seat.role});
}

void Members::add_house_bots(std::unique_ptr<bots::Team> team) {
  crew_.reserve(settings_.bots, *game_, settings_.bots_skill, std::move(team));
  for (std::uint32_t number = 0; number < settings_.bots; ++number) {
    HouseBot bot(number, game_->settings().seed);
    Seat seat{0, crew_.name_of(number, bot), protocol::Role::kBot, 0, BotOccupant{number, std::move(bot)}};
    give_louse(seat);
    crew_.take(seats_.add(std::move(seat)));
    count(protocol::Role::kBot, +1);
  }
}

/// Those who may come back give way to who is here.
bool Members::make_room(protocol::Role role, AddressId address) {
  while (!places_.has_one(role, address, settings_.limits)) {
    const auto vacant = seats_.vacant_seats([role](const Seat& seat) { return seat.role == role; });
    if (vacant.count == 0) return false;
    end(seats_.take_vacant(vacant.oldest));
  }
  return true;
}

std::optional<protocol::ErrorMessage> Members::why_not(const Arrival& arrival) {
  const protocol::Role role = arrival.join.role;
  if (!make_room(role, arrival.address))
    return error(code::kRoomFull, core::joined({"join: room ", settings_.name, " has no place for another ",
                                                protocol::to_text(role), " (",
                                                std::to_string(places_of(role, settings_.limits)),
                                                ", the last for addresses that have nobody here); try again "
                                                "later or another room"}));
  if (arrival.join.stream == protocol::Stream::kInputs && !display_.has_inputs())
    return error(code::kBadField, core::joined({"join.stream: the map of room ", settings_.name,
                                                " is too big to be watched by inputs; watch by frames"}));
  if (outlet_->backlog() > Broadcaster::kMaxBacklog)
    return error(code::kRateLimited, "join: too much is happening in room " + settings_.name, 1000);
  if (role == protocol::Role::kSpectator) return std::nullopt;  // nobody else hears of it
  if (const auto wait = budgets_.spend(Spending::kJoin, arrival.address, arrival.at))
    return error(code::kRateLimited,
                 core::joined({"join: room ", settings_.name, " takes ",
                               std::to_string(settings_.limits.join_per_s_room), " players a second"}),
                 retry_after_ms(*wait));
  if (!may_wait()) return error(code::kPaused, "join: too many have joined since the room stands still");
  return std::nullopt;
}

bool Members::is_deserted() {
  if (seats_.sessions() != 0 || seats_.vacant() != 0 || !leaving_.empty()) return false;
  if (settings_.bots_alone_play && settings_.bots != 0) return false;
  return seats_.all_rest(game_->world());
}

void Members::refuse_closed(Subscriber& subscriber) {
  subscriber.refuse_join(error(code::kShutdown, "join: the room has closed"));
}

void Members::admit(Arrival arrival) {
  assert(arrival.subscriber != nullptr && !arrival.join.name.empty());
  if (welcome_back(arrival)) return;
  if (auto refusal = arrival.unless_back ? arrival.unless_back : why_not(arrival))
    return arrival.subscriber->refuse_join(std::move(*refusal));
  const protocol::Join& join = arrival.join;
  const bool plays = join.role != protocol::Role::kSpectator;
  Seat fresh{0, join.name, join.role, 0, SessionOccupant{arrival.session, arrival.subscriber, 0}};
  fresh.address = arrival.address;
  if (plays)
    give_louse(fresh);
  else
    fresh.name = seats_.free_name(join.name, arrival.session);
  if (plays && join.may_resume) give_token(fresh);
  places_.take(fresh.role, fresh.address);
  count(fresh.role, +1);  // who has his welcome finds himself counted
  seat(std::move(fresh), arrival, false);
}

/// Who has the token of a louse that is here gets it, whether its old connection has ended or not.
bool Members::welcome_back(const Arrival& arrival) {
  const protocol::Join& join = arrival.join;
  const auto token = resume_token_from(join.resume);
  if (!token || join.role == protocol::Role::kSpectator) return false;
  std::optional<Seat> taken = seats_.take_back(digest_of(*token));
  if (!taken) return false;
  if (const auto* old = std::get_if<SessionOccupant>(&taken->occupant)) {
    skip_votes_.erase(old->session);
    display_.unsubscribe(*old);
    old->subscriber->end({std::string(code::kReplaced), "you came back over another connection", false});
    inputs_->stop(*taken);
  }
  places_.give_back(taken->role, taken->address);
  places_.take(taken->role, arrival.address);
  taken->address = arrival.address;
  taken->token = token;
  taken->last_seq.reset();
  taken->occupant = SessionOccupant{arrival.session, arrival.subscriber, 0};
  seat(std::move(*taken), arrival, true);
  return true;
}

/// The seat has all but its channel.
void Members::seat(Seat seat, const Arrival& arrival, bool is_back) {
  display_.welcome(seat, arrival, is_back, company());
  for (const auto* told : {&standing_, &notices_})
    for (const protocol::Notice& notice : *told) arrival.subscriber->answer(notice);
  display_.subscribe(std::get<SessionOccupant>(seat.occupant), events_.next());
  const Seat& added = seats_.add(std::move(seat));
  if (!is_back && added.louse != 0) send(events_.joined(game_->tick(), added));
}

void Members::begin(match::Match& game, std::unique_ptr<bots::Team> team) {
  for (const auto& [tick, session] : std::exchange(leaving_, {})) let_go(session);
  seats_.move_to(*game_, game);
  game_ = &game;
  name_map();
  inputs_.emplace(settings_, game, seats_);
  notices_.clear();
  skip_votes_.clear();
  count(protocol::Role::kBot, -static_cast<std::int32_t>(settings_.bots));
  add_house_bots(std::move(team));
  for (const auto& watcher : watchers_) tell_claims(*watcher);
  display_.begin(game, seats_, company());
}

void Members::vacate(SessionId session) {
  Seat* seat = seats_.find(session);
  if (seat != nullptr && seat->louse != 0) inputs_->stop(*seat);
}

void Members::remove(SessionId session, Parting parting) {
  skip_votes_.erase(session);
  std::optional<Seat> seat = seats_.take_away(session);
  if (!seat) return;
  display_.unsubscribe(std::get<SessionOccupant>(seat->occupant));
  if (parting == Parting::kLost && seat->claim && settings_.limits.resume_s > 0)
    return hold(std::move(*seat));
  end(*seat);
}

void Members::hold(Seat seat) {
  const auto others =
      seats_.vacant_seats([&seat](const Seat& other) { return other.address == seat.address; });
  if (others.count >= kMostVacantOfAddress) end(seats_.take_vacant(others.oldest));
  inputs_->stop(seat);
  const std::uint64_t ticks = std::uint64_t{settings_.limits.resume_s} * game_->settings().tick_hz;
  seat.occupant = Vacant{game_->tick() + ticks};
  seats_.add(std::move(seat));
}

void Members::give_up_vacant() {
  if (seats_.vacant() == 0) return;
  std::vector<match::PlayerId> over;
  seats_.for_each<Vacant>([&](const Seat& seat, const Vacant& vacant) {
    if (vacant.until <= game_->tick()) over.push_back(seat.louse);
  });
  for (const match::PlayerId louse : over) end(seats_.take_vacant(louse));
}

/// The seat is nobody's any more.
void Members::end(const Seat& seat) {
  if (seat.louse != 0) game_->leave(seat.louse);
  if (!std::holds_alternative<Nobody>(seat.occupant)) {  // who has a place
    places_.give_back(seat.role, seat.address);
    count(seat.role, -1);
  }
  if (seat.louse != 0) send(events_.left(game_->tick(), seat));
}

void Members::dismiss(const protocol::Bye& bye) {
  for (const Seat& seat : seats_.take_away_sessions()) {
    const auto& occupant = std::get<SessionOccupant>(seat.occupant);
    outlet_->remove(occupant.session, occupant.subscriber->lane());
    occupant.subscriber->end(bye);
  }
}

// ---- what they say -------------------------------------------------------------------------------------

/// What never comes as far as here: sessions answer it, or a door of its own takes it.
template <typename Message>
constexpr bool kAnsweredBefore =
    std::is_same_v<Message, protocol::Join> || std::is_same_v<Message, protocol::List> ||
    std::is_same_v<Message, protocol::Ping> || std::is_same_v<Message, protocol::Pong> ||
    std::is_same_v<Message, protocol::Moderate>;

void Members::take(SessionId session, const protocol::ClientMessage& message, Time arrived) {
  Seat* seat = seats_.find(session);
  // The room refused its join, which it has been told, or it has left since.
  if (!seat) return;
  auto& occupant = std::get<SessionOccupant>(seat->occupant);
  std::visit(
      [&](const auto& m) {
        using Message = std::decay_t<decltype(m)>;
        if constexpr (!kAnsweredBefore<Message>) on_message(*seat, occupant, m, arrived);
      },
      message);
}

bool Members::refuse_when_busy(const Seat& seat, Spending what, Time arrived) {
  std::optional<Duration> wait;
  if (outlet_->backlog() > Broadcaster::kMaxBacklog) wait = std::chrono::seconds(1);
  if (!wait) wait = budgets_.spend(what, seat.address, arrived);
  if (!wait) return false;
  std::get<SessionOccupant>(seat.occupant)
      .subscriber->answer(error(code::kRateLimited, "too much is happening in this room: this was dropped",
                                retry_after_ms(*wait)));
  return true;
}

/// Inputs reach at most InputQueue's horizon ahead, so that this is soon.
void Members::on_message(Seat&, const SessionOccupant& occupant, const protocol::Leave&, Time) {
  if (may_wait_ || occupant.acked_from <= game_->tick())  // where none follows soon none is on its way
    return outlet_->let_go(occupant.session, occupant.subscriber->lane());
  leaving_.emplace(occupant.acked_from, occupant.session);
}

void Members::on_message(Seat& seat, const SessionOccupant&, const protocol::Respawn& respawn, Time arrived) {
  if (refuse_when_busy(seat, Spending::kRespawn, arrived)) return;
  if (!may_wait())
    return std::get<SessionOccupant>(seat.occupant)
        .subscriber->answer(error(code::kPaused, "respawn: too many wait since the room stands still"));
  respawn.at_gate ? game_->respawn_at_gate(seat.louse) : game_->respawn(seat.louse);
  send(events_.respawned(game_->tick(), seat));
}

void Members::on_message(Seat& seat, const SessionOccupant& occupant, const protocol::Skip&, Time) {
  if (settings_.rounds_a_game == 0 || seat.role != protocol::Role::kPlayer)
    return occupant.subscriber->answer(error(code::kNoVote, settings_.rounds_a_game == 0
                                                                ? "skip: this room plays one game alone"
                                                                : "skip: bots have no vote"));
  if (skip_votes_.emplace(occupant.session, seat.address).second)
    send(events_.skip(game_->tick(), seat, votes(), votes_needed()));
}

std::size_t Members::votes() const {
  std::set<AddressId> addresses;
  for (const auto& [session, address] : skip_votes_) addresses.insert(address);
  assert(addresses.size() <= seats_.player_addresses());
  return addresses.size();
}

// ---- what they are shown -------------------------------------------------------------------------------

void Members::tell(const LiveStep& step) {
  display_.show_step(step);
  for (const rules::Event& event : step.record().events) {
    const auto label = game_->labels().find(event.louse);
    send(events_.ruled(event, label != game_->labels().end() ? label->second.name : std::string(),
                       *game_->rules()));
  }
}

void Members::answer(std::uint64_t tick, Time begun) {
  assert(tick + 1 == game_->tick());
  inputs_->answer(tick, begun);
  while (!leaving_.empty() && leaving_.begin()->first <= game_->tick())
    let_go(leaving_.extract(leaving_.begin()).mapped());
}

void Members::let_go(SessionId session) {
  if (const Seat* seat = seats_.find(session))
    outlet_->let_go(session, std::get<SessionOccupant>(seat->occupant).subscriber->lane());
}

}  // namespace woodlouse::server
