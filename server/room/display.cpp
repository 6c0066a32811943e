#include "server/room/display.h"

#include <cassert>
#include <utility>
#include <variant>

#include "server/room/shown_game.h"
#include "server/room/welcome.h"

namespace woodlouse::server {

Display::Display(const RoomSettings& settings, match::Match& game, Outlet& outlet)
    : settings_(settings), game_(&game), outlet_(outlet), map_line_(encode_map_line(game.map())) {
  assert(settings_.state_hz >= 1 && game_->settings().tick_hz % settings_.state_hz == 0);
}

protocol::Welcome Display::welcome_to_all(Company company) const {
  protocol::Welcome welcome = welcome_for(settings_, *game_, map_line_->size());
  welcome.players = std::move(company.players);
  welcome.spectators = company.spectators;
  return welcome;
}

void Display::welcome(Seat& seat, const Arrival& arrival, bool is_back, Company company) {
  const protocol::Join& join = arrival.join;
  const auto acquired =
      layouts_.acquire({join.fields, join.format, shows_part(join.view.value_or(protocol::View{}))},
                       arrival.address, settings_.limits.layouts_per_address);
  auto& occupant = std::get<SessionOccupant>(seat.occupant);
  occupant.channel = acquired.channel;
  occupant.state_hz = granted_state_hz(wanted_state_hz(join, arrival.is_web), settings_.state_hz);
  protocol::Welcome welcome =
      addressed(welcome_to_all(std::move(company)), addressee_of(seat, layouts_.layout(acquired.channel)));
  welcome.resumed = is_back;
  occupant.subscriber->welcome(std::move(welcome), settings_.state_hz / occupant.state_hz);
  if (acquired.is_new) outlet_.open(acquired.channel, layouts_.layout(acquired.channel));
  show_newest(occupant);
}

void Display::subscribe(const SessionOccupant& occupant, std::uint64_t first_event) {
  outlet_.add({occupant.session, occupant.subscriber, occupant.channel, first_event});
}

void Display::unsubscribe(const SessionOccupant& occupant) {
  turning_.erase(occupant.session);
  outlet_.remove(occupant.session, occupant.subscriber->lane());
  if (layouts_.release(occupant.channel)) outlet_.close(occupant.channel);
}

void Display::begin(match::Match& game, Seats& seats, Company company) {
  assert(game.tick() == 0 && &game != game_);
  game_ = &game;
  map_line_ = encode_map_line(game.map());
  snapshot_.reset();
  outlet_.begin_anew();
  const auto to_all = std::make_shared<const protocol::Welcome>(welcome_to_all(std::move(company)));
  seats.for_each<SessionOccupant>([&](const Seat& seat, const SessionOccupant& occupant) {
    // Each is made on its way: a crowd's, with everybody's name in it, would hold up the tick.
    outlet_.welcome(
        occupant.subscriber,
        [to_all, to = addressee_of(seat, layouts_.layout(occupant.channel))] {
          return addressed(*to_all, to);
        },
        settings_.state_hz / occupant.state_hz);
    show_newest(occupant);
  });
}

std::uint64_t Display::ticks_a_frame() const { return game_->settings().tick_hz / settings_.state_hz; }

SharedSnapshot Display::snapshot() {
  if (!snapshot_ || snapshot_->tick != game_->tick()) {
    snapshot_.reset();
    snapshot_ = take_snapshot(snapshots_, scene_of(*game_, ticks_a_frame()));
  }
  return snapshot_;
}

/// To the same columns in sheets, or not; where there are too many choices to a wider one that has no more.
void Display::turn(SessionOccupant& occupant, AddressId address, bool shows_part) {
  RowLayout layout = layouts_.layout(occupant.channel);
  if (std::exchange(layout.in_sheets, shows_part) == shows_part) return;
  const auto acquired = layouts_.acquire(layout, address, settings_.limits.layouts_per_address);
  if (layouts_.layout(acquired.channel).fields != layout.fields) {
    // The welcome has named the columns: it goes on being shown what it was.
    static_cast<void>(layouts_.release(acquired.channel));
    return;
  }
  if (acquired.is_new) outlet_.open(acquired.channel, layout);
  outlet_.move(occupant.session, occupant.subscriber->lane(), acquired.channel);
  if (layouts_.release(occupant.channel)) outlet_.close(occupant.channel);
  occupant.channel = acquired.channel;
}

void Display::send_frames(Seats& seats) {
  if (game_->tick() % ticks_a_frame() != 0 || layouts_.empty()) return;
  const bool is_key = game_->tick() / ticks_a_frame() % settings_.state_hz == 0;
  if (is_key)
    for (const auto& [session, shows_part] : std::exchange(turning_, {}))
      if (Seat* seat = seats.find(session))
        turn(std::get<SessionOccupant>(seat->occupant), seat->address, shows_part);
  outlet_.show(is_key ? FrameKind::kKey : FrameKind::kDelta, snapshot());
}

}  // namespace woodlouse::server
