// Who is in a room and what passes between them and the game: joins and leaves, messages in; frames, events
// and answers out. The room's clock says when. The room's strand owns it.
#pragma once

#include <spdlog/logger.h>

#include <atomic>
#include <cassert>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/room/display.h"
#include "server/room/door.h"
#include "server/room/events.h"
#include "server/room/house_crew.h"
#include "server/room/input_desk.h"
#include "server/room/lanes.h"
#include "server/room/outlet.h"
#include "server/room/places.h"
#include "server/room/room_budgets.h"
#include "server/room/room_settings.h"
#include "server/room/seats.h"
#include "server/room/tick_watcher.h"
#include "server/timing/clock.h"
#include "shared/match/match.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

class Members {
 public:
  /// Of one address: more than a router's hiccup takes of a household.
  static constexpr std::size_t kMostVacantOfAddress = 8;
  /// Joins and respawns that wait while the room is paused.
  static constexpr std::size_t kMostPaused = 4096;

  /// lanes: where events and frames are handed out. settings and watchers outlive it, a game until the next
  /// one begins.
  Members(const Lanes& lanes, const RoomSettings& settings, match::Match& game, const Watchers& watchers,
          std::vector<Seat> unclaimed, Time now, std::shared_ptr<spdlog::logger> log);

  /// Once a game, before its first tick. team: Start's.
  void add_house_bots(std::unique_ptr<bots::Team> team);
  /// The room plays this one from now on, with the watchers as they now are: everybody who is here joins it,
  /// the house's bots as well, and is welcomed anew. It has not begun.
  void begin(match::Match& game, std::unique_ptr<bots::Team> team);
  /// Of more than half of the addresses from which players are here, one has voted for the next game.
  [[nodiscard]] bool wants_next() const { return !skip_votes_.empty() && votes() >= votes_needed(); }
  /// Who may come back to which louse; behind the watcher's begin().
  void tell_claims(TickWatcher& watcher) {
    const auto tell = [&watcher](const Seat& seat, const auto&) {
      if (seat.claim && seat.louse != 0) watcher.claimed(claim_of(seat));
    };
    seats_.for_each<SessionOccupant>(tell);
    seats_.for_each<Vacant>(tell);
  }
  /// The lice go that were somebody's in the game that this one goes on from, and are nobody's here.
  void end_unclaimed() {
    std::vector<const Seat*> unclaimed;
    seats_.for_each<Nobody>([&](const Seat& seat, const Nobody&) { unclaimed.push_back(&seat); });
    for (const Seat* seat : unclaimed) end(seats_.take_away(*seat));
  }
  void steer_house_bots() {
    for (const Seat* seat : crew_.steer(*game_)) send(events_.respawned(game_->tick(), *seat));
  }

  void admit(Arrival arrival);
  static void refuse_closed(Subscriber& subscriber);
  static void refuse_held(Subscriber& subscriber);
  void vacate(SessionId session);
  void remove(SessionId session, Parting parting);
  /// The lice go whose players have not come back in time.
  void give_up_vacant();
  void take(SessionId session, const protocol::ClientMessage& message, Time arrived);
  /// To who is here, and to whoever joins later, behind the welcome.
  void announce(const protocol::Notice& notice);
  /// To who is here.
  void say(const protocol::Notice& notice);
  /// To who is here, and to whoever joins while it is so: in place of one of the same code.
  void say_from_now_on(const protocol::Notice& notice);
  /// No tick passes till resume(): who joins hears so, too, and what waits for the next tick is bounded.
  void pause();
  void resume();
  /// No step follows for a while, as what was played is kept first: what waits for the next one is bounded.
  void await_keeping() {
    if (!may_wait_) may_wait_ = kMostPaused;
    display_.begin_keeping();
  }
  void end_keeping() {
    if (!is_paused_) may_wait_.reset();
    display_.end_keeping(seats_);
  }
  /// No step follows for now.
  void stand() { display_.stand(seats_); }
  /// What waited has been done by a tick.
  void refill() {
    if (may_wait_) may_wait_ = kMostPaused;
  }
  /// He comes back no more: a louse that nobody steers now goes. Who sits there, and is still to be ended;
  /// 0: nobody.
  [[nodiscard]] SessionId put_out(const RosterEntry& whom);
  /// His chat is refused until then, also when he has gone and comes back to his louse; Time{}: no more.
  /// ends: the same by the calendar, as a Claim has it.
  void mute(const RosterEntry& whom, Time until, std::uint64_t ends) {
    Seat* seat = seats_.find(whom);
    if (seat == nullptr) return;
    seat->muted_until = until;
    seat->mute_ends = ends;
    if (seat->claim && seat->louse != 0) tell_claim(*seat);
  }
  [[nodiscard]] std::vector<RosterEntry> roster(Time now) const { return seats_.roster(now); }
  /// Says bye to every session; they are members no more.
  void dismiss(const protocol::Bye& bye);
  /// settings.limits are others now.
  void renew_budgets(Time now) { budgets_ = RoomBudgets(settings_.limits, now); }

  /// How long before step `tick`, begun at `begun`, its inputs came; then answer() tells them.
  std::span<const InputMargin> margins(std::uint64_t tick, Time begun) {
    return inputs_->margins(tick, begun);
  }
  void answer(std::uint64_t tick, Time begun);
  /// What the rules of play said of the step, and the step itself to who watches by inputs.
  void tell(const LiveStep& step);
  /// What a watcher has to tell.
  void tell(const protocol::Event& event) { send(events_.told(event)); }
  void send_frames() { display_.send_frames(seats_); }

  /// No session is here, nobody may come back, and nothing goes on that somebody began.
  [[nodiscard]] bool is_deserted();

  /// Any thread.
  [[nodiscard]] protocol::RoomEntry census() const;
  /// Events that are still on their way out.
  [[nodiscard]] std::size_t backlog() const { return outlet_->backlog(); }
  [[nodiscard]] std::uint64_t frames_encoded() const { return outlet_->frames_encoded(); }

 private:
  [[nodiscard]] std::optional<protocol::ErrorMessage> why_not(const Arrival& arrival);
  bool make_room(protocol::Role role, AddressId address);
  bool welcome_back(const Arrival& arrival);
  void seat(Seat seat, const Arrival& arrival, bool is_back);
  [[nodiscard]] Company company() const { return {seats_.entries(), spectators_.load()}; }
  void give_louse(Seat& seat);
  /// Who may come back from the start has his place.
  void place_vacant() {
    seats_.for_each<Vacant>([this](const Seat& seat, const Vacant&) {
      places_.take(seat.role, seat.address);
      count(seat.role, +1);
    });
  }
  void give_token(Seat& seat) {
    assert(seat.louse != 0);
    seat.token = make_resume_token();
    seat.claim = digest_of(*seat.token);
    tell_claim(seat);
  }
  void tell_claim(const Seat& seat) {
    for (const auto& watcher : watchers_) watcher->claimed(claim_of(seat));
  }
  void hold(Seat seat);
  void end(const Seat& seat);
  void on_message(Seat& seat, SessionOccupant& occupant, const protocol::Input& input, Time arrived) {
    inputs_->file(seat, occupant, input, arrived);
  }
  void on_message(Seat& seat, const SessionOccupant&, const protocol::Chat& chat, Time arrived);
  void on_message(Seat& seat, const SessionOccupant& occupant, const protocol::Leave&, Time);
  void on_message(Seat&, SessionOccupant& occupant, const protocol::GetMap&, Time) {
    display_.show_map(occupant);
  }
  void on_message(Seat&, SessionOccupant& occupant, const protocol::Resync&, Time) {
    display_.show_newest(occupant);
  }
  void on_message(Seat&, const SessionOccupant& occupant, const protocol::Look& look, Time) {
    display_.look(occupant.session, look.view);
  }
  void on_message(Seat& seat, const SessionOccupant&, const protocol::Respawn&, Time arrived);
  void on_message(Seat& seat, const SessionOccupant& occupant, const protocol::Skip&, Time);
  void on_message(Seat&, const SessionOccupant& occupant, const protocol::ListRecords& list, Time) {
    look_up(occupant, list);
  }
  void on_message(Seat&, const SessionOccupant& occupant, const protocol::GetGhost& get, Time) {
    look_up(occupant, get);
  }
  void look_up(const SessionOccupant& occupant, const protocol::ClientMessage& question) {
    for (const auto& watcher : watchers_)
      if (Line found = watcher->answer(question))
        return occupant.subscriber->deliver_record(std::move(found));
    occupant.subscriber->answer(protocol::ErrorMessage{
        std::string(protocol::code::kNoRecords),
        "there is no such record: the room keeps none, or its board has no row of that rank",
        false,
        {}});
  }
  /// Whether another change may wait for the next tick; then it counts.
  [[nodiscard]] bool may_wait() { return !may_wait_ || (*may_wait_ > 0 && (*may_wait_)-- > 0); }
  [[nodiscard]] bool refuse_when_busy(const Seat& seat, Spending what, Time arrived);
  void let_go(SessionId session);
  void send(const NumberedLine& event) { outlet_->event(event.number, event.line); }
  void count(protocol::Role role, std::int32_t change);
  /// An address has one, however many players of it are here: nobody outvotes others by connecting often.
  [[nodiscard]] std::size_t votes() const;
  [[nodiscard]] std::size_t votes_needed() const { return seats_.player_addresses() / 2 + 1; }
  void name_map();

  const RoomSettings& settings_;
  match::Match* game_;
  const Watchers& watchers_;
  std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<Outlet> outlet_;
  Display display_;
  mutable std::mutex map_name_mutex_;
  std::string map_name_;  ///< for census()
  std::atomic<std::uint32_t> players_{0}, bots_{0}, spectators_{0};
  Seats seats_;
  std::optional<InputDesk> inputs_;  ///< of the game
  Places places_;
  RoomBudgets budgets_;
  std::multimap<std::uint64_t, SessionId>
      leaving_;                             ///< by the tick from which on all their inputs are acknowledged
  std::vector<protocol::Notice> notices_;   ///< of this game, announced so far; a watcher has one or two
  std::vector<protocol::Notice> standing_;  ///< of the operator, one of a code: true of every game
  Events events_;
  HouseCrew crew_;
  std::map<SessionId, AddressId> skip_votes_;  ///< of players who are here
  std::optional<std::size_t> may_wait_;  ///< so many more joins and respawns; none: the next tick comes soon
  bool is_paused_ = false;
};

}  // namespace woodlouse::server
