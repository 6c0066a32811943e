#include "server/room/display.h"

#include <cassert>
#include <utility>
#include <variant>

#include "server/room/shown_game.h"
#include "shared/replay/line_writer.h"

namespace woodlouse::server {

Display::Display(const RoomSettings& settings, const match::Match& game, Outlet& outlet)
    : settings_(settings), game_(&game), outlet_(outlet), map_line_(encode_map_line(game.map())) {
  assert(settings_.state_hz >= 1 && game_->settings().tick_hz % settings_.state_hz == 0);
}

protocol::Welcome Display::welcome_to_all(Company company) const {
  protocol::Welcome welcome = welcome_for(settings_, *game_, map_line_->size());
  welcome.players = std::move(company.players);
  welcome.spectators = company.spectators;
  return welcome;
}

/// The seat's channel, for the game as it is.
void Display::choose(Seat& seat, const RowLayout& rows) {
  auto& occupant = std::get<SessionOccupant>(seat.occupant);
  if (occupant.rows_instead && has_inputs()) {
    occupant.channel = kByInputs;
    return;
  }
  const auto acquired = layouts_.acquire(rows, seat.address, settings_.limits.layouts_per_address);
  occupant.channel = acquired.channel;
  if (acquired.is_new) outlet_.open(acquired.channel, layouts_.layout(acquired.channel));
}

Addressee Display::addressee(const Seat& seat) const {
  const auto& occupant = std::get<SessionOccupant>(seat.occupant);
  const bool is_by_inputs = occupant.channel == kByInputs;
  return addressee_of(seat, is_by_inputs ? *occupant.rows_instead : layouts_.layout(occupant.channel));
}

/// Behind the welcome.
void Display::show_first(const SessionOccupant& occupant) {
  if (occupant.channel == kByInputs) return ask({occupant.subscriber, true});
  show_newest(occupant);
}

void Display::welcome(Seat& seat, const Arrival& arrival, bool is_back, Company company) {
  const protocol::Join& join = arrival.join;
  const RowLayout rows{join.fields, join.format, shows_part(join.view.value_or(protocol::View{}))};
  auto& occupant = std::get<SessionOccupant>(seat.occupant);
  if (join.stream == protocol::Stream::kInputs) occupant.rows_instead = rows;
  occupant.state_hz = granted_state_hz(wanted_state_hz(join, arrival.is_web), settings_.state_hz);
  choose(seat, rows);
  protocol::Welcome welcome = addressed(welcome_to_all(std::move(company)), addressee(seat));
  welcome.resumed = is_back;
  occupant.subscriber->welcome(std::move(welcome), settings_.state_hz / occupant.state_hz);
  show_first(occupant);
}

void Display::subscribe(const SessionOccupant& occupant, std::uint64_t first_event) {
  outlet_.add({occupant.session, occupant.subscriber, occupant.channel, first_event});
  if (occupant.channel == kByInputs) ++by_inputs_;
}

void Display::unsubscribe(const SessionOccupant& occupant) {
  turning_.erase(occupant.session);
  outlet_.remove(occupant.session, occupant.subscriber->lane());
  if (occupant.channel != kByInputs) {
    if (layouts_.release(occupant.channel)) outlet_.close(occupant.channel);
    return;
  }
  assert(by_inputs_ > 0);
  if (--by_inputs_ == 0) keyframe_tick_.reset();  // nobody is told of the steps that follow it
}

bool Display::has_inputs() const { return replay::holds_map(game_->map()); }

void Display::go_on(const match::Match& game) {
  assert(game.settings().tick_hz % settings_.state_hz == 0);
  game_ = &game;
  snapshot_.reset();
  keyframe_tick_.reset();
}

void Display::begin(const match::Match& game, Seats& seats, Company company) {
  assert(game.settings().tick_hz % settings_.state_hz == 0);
  game_ = &game;
  map_line_ = encode_map_line(game.map());
  snapshot_.reset();
  header_.reset();
  asked_.clear();
  keyframe_tick_.reset();
  outlet_.begin_anew();
  const auto to_all = std::make_shared<const protocol::Welcome>(welcome_to_all(std::move(company)));
  seats.for_each<SessionOccupant>([&](Seat& seat, SessionOccupant& occupant) {
    if (occupant.rows_instead && has_inputs() != (occupant.channel == kByInputs)) change_over(seat, occupant);
    // Each is made on its way: a crowd's, with everybody's name in it, would hold up the tick.
    outlet_.welcome(
        occupant.subscriber, [to_all, to = addressee(seat)] { return addressed(*to_all, to); },
        settings_.state_hz / occupant.state_hz);
    show_first(occupant);
  });
}

/// From the stream to frames, or back, as the map wants it.
void Display::change_over(Seat& seat, SessionOccupant& occupant) {
  const ChannelId former = occupant.channel;
  choose(seat, *occupant.rows_instead);
  assert((former == kByInputs) != (occupant.channel == kByInputs));
  outlet_.change(occupant.session, occupant.subscriber->lane(), occupant.channel);
  if (former == kByInputs) {
    --by_inputs_;
    return;
  }
  ++by_inputs_;
  if (layouts_.release(former)) outlet_.close(former);
}

const Line& Display::header() {
  if (!header_) {
    std::string text;
    replay::append_header(text, replay::make_header(*game_, settings_.build, {}));
    header_ = Line(std::move(text));
  }
  return header_;
}

void Display::show_step(const LiveStep& step) {
  stands_ = false;
  if (by_inputs_ == 0) return asked_.clear();  // who asked has gone
  const std::uint64_t tick = game_->tick();
  const std::uint64_t tick_hz = game_->settings().tick_hz;
  assert(tick == step.record().tick + 1);
  std::optional<InputStream::Quiet> goes_out;
  if (tick % ticks_a_frame() == 0)
    goes_out = tick % tick_hz == 0 ? InputStream::Quiet::kTold : InputStream::Quiet::kHeldBack;
  outlet_.show_step(step.shared(), goes_out);
  answer_asked();
}

/// What waits for a step to come is in no keyframe: it is waited for.
void Display::answer_asked() {
  if (asked_.empty() || !game_->state().roster.empty()) return;
  const std::uint64_t tick = game_->tick();
  const std::uint64_t tick_hz = game_->settings().tick_hz;
  if (!keyframe_tick_ || tick - *keyframe_tick_ >= tick_hz) {
    outlet_.keep_keyframe(game_->state(), tick_hz);
    keyframe_tick_ = tick;
  }
  for (Asked& asked : asked_)
    outlet_.show_keyframe(std::move(asked.subscriber), asked.wants_header ? header() : Line());
  asked_.clear();
}

std::uint64_t Display::ticks_a_frame() const { return game_->settings().tick_hz / settings_.state_hz; }

SharedSnapshot Display::snapshot() {
  if (!snapshot_ || snapshot_->tick != game_->tick()) {
    snapshot_.reset();
    snapshot_ = take_snapshot(snapshots_, scene_of(*game_, ticks_a_frame()));
  }
  return snapshot_;
}

/// To the same columns in sheets, or not; where there are too many choices it goes on being shown what it
/// was, as the welcome has named the columns.
void Display::turn(Seat& seat, bool shows_part) {
  auto& occupant = std::get<SessionOccupant>(seat.occupant);
  if (occupant.rows_instead) occupant.rows_instead->in_sheets = shows_part;
  if (occupant.channel == kByInputs) return;
  const ChannelId former = occupant.channel;
  RowLayout layout = layouts_.layout(former);
  if (std::exchange(layout.in_sheets, shows_part) == shows_part) return;
  const auto acquired = layouts_.acquire(layout, seat.address, settings_.limits.layouts_per_address);
  if (layouts_.layout(acquired.channel).fields != layout.fields) {
    static_cast<void>(layouts_.release(acquired.channel));
    return;
  }
  occupant.channel = acquired.channel;
  if (acquired.is_new) outlet_.open(acquired.channel, layout);
  outlet_.change(occupant.session, occupant.subscriber->lane(), acquired.channel);
  if (layouts_.release(former)) outlet_.close(former);
}

void Display::end_keeping(Seats& seats) {
  keeps_ = false;
  for (const SessionId session : std::exchange(later_, {}))
    if (const Seat* seat = seats.find(session)) show_newest(std::get<SessionOccupant>(seat->occupant));
}

void Display::stand(Seats& seats) {
  assert(!keeps_);
  stands_ = true;
  if (by_inputs_ != 0) outlet_.show_steps_left();
  answer_asked();
  if (layouts_.empty()) return;
  if (game_->tick() % ticks_a_frame() != 0) outlet_.show(FrameKind::kDelta, snapshot());
  outlet_.flush();
  // Who is sent but some of the frames may not have had the last one.
  seats.for_each<SessionOccupant>([&](const Seat&, const SessionOccupant& occupant) {
    if (occupant.channel != kByInputs && occupant.state_hz < settings_.state_hz) show_newest(occupant);
  });
}

void Display::send_frames(Seats& seats) {
  if (game_->tick() % ticks_a_frame() != 0 || layouts_.empty()) return;
  const bool is_key = game_->tick() / ticks_a_frame() % settings_.state_hz == 0;
  if (is_key)
    for (const auto& [session, shows_part] : std::exchange(turning_, {}))
      if (Seat* seat = seats.find(session)) turn(*seat, shows_part);
  outlet_.show(is_key ? FrameKind::kKey : FrameKind::kDelta, snapshot());
}

}  // namespace woodlouse::server
