#include "server/room/members.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <type_traits>
#include <utility>
#include <variant>

#include "server/room/room_map.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace code = protocol::code;
using std::chrono::duration_cast;
using std::chrono::microseconds;

protocol::ErrorMessage error(std::string_view code, std::string text,
                             std::optional<std::uint32_t> retry_after_ms = {}) {
  return {std::string(code), std::move(text), false, retry_after_ms};
}

/// The largest divisor of `most` that does not exceed `wanted`, so that keys stay a second apart.
std::uint32_t granted_state_hz(std::optional<std::uint32_t> wanted, std::uint32_t most) {
  std::uint32_t hz = std::min(wanted.value_or(most), most);
  while (most % hz != 0) --hz;
  return hz;
}

}  // namespace

Members::Members(boost::asio::io_context& io, const RoomSettings& settings, match::Match& game,
                 const Watchers& watchers, std::vector<Seat> unclaimed, std::shared_ptr<spdlog::logger> log)
    : settings_(settings),
      game_(game),
      watchers_(watchers),
      log_(std::move(log)),
      broadcaster_(std::make_shared<Broadcaster>(io)),
      map_line_(encode_map_line(game.map())),
      seats_(std::move(unclaimed)) {
  assert(settings_.state_hz >= 1 && game_.settings().tick_hz % settings_.state_hz == 0);
}

// ---- who is here ---------------------------------------------------------------------------------------

protocol::RoomEntry Members::census() const {
  return {settings_.name, game_.map().definition.name, players_.load(), bots_.load(), spectators_.load()};
}

void Members::count(protocol::Role role, std::int32_t change) {
  auto& counter = role == protocol::Role::kPlayer ? players_
                  : role == protocol::Role::kBot  ? bots_
                                                  : spectators_;
  counter.fetch_add(static_cast<std::uint32_t>(change));
}

void Members::give_louse(Seat& seat) {
  const std::optional<Seat> taken = seats_.take_over(seat.name);
  seat.louse = taken ? taken->louse : game_.join({seat.name, seat.role});
  seat.first_seq = taken ? taken->first_seq : 0;
  const bool is_session = std::holds_alternative<SessionOccupant>(seat.occupant);
  if (taken && is_session)
    log_->info(fmt::format("room {}: \"{}\" takes over louse {} of the recording", settings_.name, seat.name,
                           seat.louse));
}

void Members::add_house_bots() {
  // Spread over a period, so that no tick pays for all of them.
  bots_by_turn_.resize(std::max(1u, game_.settings().tick_hz / HouseBot::kDecisionsPerSecond));
  for (std::uint32_t number = 0; number < settings_.bots; ++number) {
    HouseBot bot(number, game_.settings().seed);
    Seat seat{0, bot.name(), protocol::Role::kBot, 0, BotOccupant{number, std::move(bot)}};
    give_louse(seat);
    Seat& added = seats_.add(std::move(seat));
    bots_by_turn_[added.louse % bots_by_turn_.size()].push_back(&added);
    count(protocol::Role::kBot, +1);
  }
}

void Members::steer_house_bots() {
  const std::uint64_t period = bots_by_turn_.size();
  assert(period != 0);
  const auto& world = game_.world();
  for (Seat* seat : bots_by_turn_[(period - game_.tick() % period) % period]) {
    const state::Louse* louse = world.find(seat->louse);
    if (!louse) continue;
    HouseBot& bot = std::get<BotOccupant>(seat->occupant).bot;
    const state::Thrust thrust = bot.decide({*louse, world.terrain(), world.parameters()});
    game_.file({seat->louse, ++seat->first_seq, thrust, state::kHeld, 0});
  }
}

std::optional<protocol::ErrorMessage> Members::why_not() const {
  if (seats_.sessions() >= settings_.per_room)
    return error(code::kRoomFull, "join: room " + settings_.name + " is full (" +
                                      std::to_string(settings_.per_room) +
                                      "); try again later or another room");
  if (broadcaster_->backlog() > Broadcaster::kMaxBacklog)
    return error(code::kRateLimited, "join: too much is happening in room " + settings_.name, 1000);
  return std::nullopt;
}

bool Members::is_deserted() {
  if (seats_.sessions() != 0 || !leaving_.empty()) return false;
  if (settings_.bots_alone_play && settings_.bots != 0) return false;
  const auto is_on = [](const state::Louse& louse) {
    const bool counts_down = louse.thrust_ticks != 0 && louse.thrust_ticks != state::kHeld;
    return louse.phase != state::Phase::kResting || counts_down;
  };
  const auto lice = game_.world().lice();
  std::ptrdiff_t on = std::count_if(lice.begin(), lice.end(), is_on);
  seats_.for_each<BotOccupant>([&](const Seat& seat, const BotOccupant&) {
    const state::Louse* louse = game_.world().find(seat.louse);
    if (louse != nullptr && is_on(*louse)) --on;
  });
  assert(on >= 0);
  return on == 0;
}

void Members::refuse_closed(Subscriber& subscriber) {
  subscriber.refuse_join(error(code::kShutdown, "join: the room has closed"));
}

void Members::admit(SessionId session, std::shared_ptr<Subscriber> subscriber, const protocol::Join& join) {
  if (auto refusal = why_not()) return subscriber->refuse_join(std::move(*refusal));
  const ChannelId channel = channels_.acquire({join.fields, join.format});
  Seat seat{0, join.name, join.role, 0, SessionOccupant{session, subscriber, channel}};
  const std::uint32_t state_hz = granted_state_hz(join.state_hz, settings_.state_hz);
  if (join.role != protocol::Role::kSpectator) give_louse(seat);
  count(seat.role, +1);  // who has his welcome finds himself counted
  subscriber->welcome(welcome_for(seat, state_hz), settings_.state_hz / state_hz);
  for (const Frame& frame : channels_.newest(channel, scene())) subscriber->show_again(frame);
  broadcaster_->add({session, std::move(subscriber), channel, events_.next()});
  const Seat& added = seats_.add(std::move(seat));
  log_->info(fmt::format("room {}: session {:016x} joined as {} {} \"{}\"", settings_.name, session,
                         protocol::to_text(added.role), added.louse, added.name));
  send(events_.joined(game_.tick(), added));
}

protocol::Welcome Members::welcome_for(const Seat& seat, std::uint32_t state_hz) const {
  const map::Map& map = game_.map();
  const terrain::Rectangle& domain = map.terrain->domain();
  protocol::Welcome welcome;
  welcome.id = seat.louse;
  welcome.room = settings_.name;
  welcome.tick = game_.tick();
  welcome.tick_hz = game_.settings().tick_hz;
  welcome.state_hz = state_hz;
  const RowLayout& layout = channels_.layout(std::get<SessionOccupant>(seat.occupant).channel);
  welcome.fields = layout.fields;
  welcome.format = layout.format;
  welcome.map_name = map.definition.name;
  welcome.map_hash = map.hash;
  welcome.extent = {domain.x_min, domain.y_min, domain.x_max, domain.y_max};
  welcome.map_bytes = map_line_->size();
  welcome.physics = map.definition.physics;
  welcome.mode = "roam";
  welcome.players = seats_.entries();
  return welcome;
}

void Members::remove(SessionId session) {
  const std::optional<Seat> seat = seats_.take_away(session);
  if (!seat) return;
  if (seat->louse != 0) game_.leave(seat->louse);
  channels_.release(std::get<SessionOccupant>(seat->occupant).channel);
  broadcaster_->remove(session);
  count(seat->role, -1);
  log_->info(fmt::format("room {}: session {:016x} left ({} {})", settings_.name, session,
                         protocol::to_text(seat->role), seat->louse));
  send(events_.left(game_.tick(), *seat));
}

void Members::announce(const protocol::Notice& notice) {
  seats_.for_each<SessionOccupant>(
      [&](const Seat&, const SessionOccupant& occupant) { occupant.subscriber->answer(notice); });
}

void Members::dismiss(const protocol::Bye& bye) {
  for (const Seat& seat : seats_.take_away_sessions()) {
    const auto& occupant = std::get<SessionOccupant>(seat.occupant);
    broadcaster_->remove(occupant.session);
    occupant.subscriber->end(bye);
  }
}

// ---- what they say -------------------------------------------------------------------------------------

/// What never comes as far as here: sessions answer it, or a door of its own takes it.
template <typename Message>
constexpr bool kAnsweredBefore =
    std::is_same_v<Message, protocol::Join> || std::is_same_v<Message, protocol::List> ||
    std::is_same_v<Message, protocol::Ping> || std::is_same_v<Message, protocol::Pong>;

void Members::take(SessionId session, const protocol::ClientMessage& message, Time arrived) {
  Seat* seat = seats_.find(session);
  // The room refused its join, which it has been told, or it has left since.
  if (!seat) return;
  auto& occupant = std::get<SessionOccupant>(seat->occupant);
  std::visit(
      [&](const auto& m) {
        using Message = std::decay_t<decltype(m)>;
        if constexpr (std::is_same_v<Message, protocol::Input>)
          on_message(*seat, occupant, m, arrived);
        else if constexpr (!kAnsweredBefore<Message>)
          on_message(*seat, occupant, m);
      },
      message);
}

void Members::on_message(Seat& seat, SessionOccupant& occupant, const protocol::Input& input, Time arrived) {
  const std::uint32_t seq = seat.first_seq + input.seq;
  match::Filed filed =
      game_.file({seat.louse, seq, input.thrust, input.ticks.value_or(state::kHeld), input.tick.value_or(0)});
  filed.late |= input.tick == 0u && game_.tick() > 0;  // to the match 0 is no wish
  if (filed.outcome != match::Filed::Outcome::kFiled) return drop_input(occupant, input, filed);
  const std::uint64_t ticks_late = filed.late ? filed.tick - input.tick.value_or(filed.tick) : 0;
  occupant.acked_from = std::max(occupant.acked_from, filed.tick + 1);
  acks_.add(filed.tick, {occupant.session, seat.louse, seq, arrived, filed.late, input.clamped, ticks_late});
}

void Members::drop_input(SessionOccupant& occupant, const protocol::Input& input, const match::Filed& filed) {
  const std::string where = "input " + std::to_string(input.seq) + " dropped: ";
  Subscriber& subscriber = *occupant.subscriber;
  switch (filed.outcome) {
    case match::Filed::Outcome::kFiled:
      return;
    case match::Filed::Outcome::kStaleSeq:
      // No ack: it would be taken for that of the input that came first under this seq.
      return subscriber.answer(
          error(code::kStaleSeq, where + "seq must be above that of every input before"));
    case match::Filed::Outcome::kQueueFull:
      subscriber.answer(error(code::kQueueFull, where + std::to_string(match::InputQueue::kMaxPending) +
                                                    " of your inputs wait for their tick"));
      break;
    case match::Filed::Outcome::kTooFar:
      subscriber.answer(error(code::kTooFar, where + "tick " + std::to_string(filed.tick) +
                                                 " is more than 2 s after the present " +
                                                 std::to_string(game_.tick())));
      break;
    case match::Filed::Outcome::kNoLouse:
      subscriber.answer(error(code::kNoLouse, where + "you have no louse"));
      break;
  }
  protocol::Ack ack;
  ack.seq = input.seq;
  ack.tick = game_.tick();
  ack.late = filed.late;
  ack.dropped = true;
  ack.clamped = input.clamped;
  subscriber.answer(ack);
}

bool Members::refuse_when_busy(SessionOccupant& occupant) const {
  if (broadcaster_->backlog() <= Broadcaster::kMaxBacklog) return false;
  occupant.subscriber->answer(error(code::kRateLimited, "too much is happening in this room", 1000));
  return true;
}

void Members::on_message(Seat& seat, SessionOccupant& occupant, const protocol::Chat& chat) {
  if (refuse_when_busy(occupant)) return;
  for (const auto& watcher : watchers_) watcher->chat(game_.tick(), seat.louse, seat.name, chat.text);
  send(events_.chat(game_.tick(), seat, chat.text));
}

/// Inputs reach at most InputQueue's horizon ahead, so that this is soon.
void Members::on_message(Seat&, const SessionOccupant& occupant, const protocol::Leave&) {
  if (occupant.acked_from <= game_.tick()) return broadcaster_->let_go(occupant.session);
  leaving_.emplace(occupant.acked_from, occupant.session);
}

void Members::on_message(Seat&, SessionOccupant& occupant, const protocol::GetMap&) {
  occupant.subscriber->deliver_map(map_line_);
}

void Members::on_message(Seat&, SessionOccupant& occupant, const protocol::Resync&) {
  for (const Frame& frame : channels_.newest(occupant.channel, scene()))
    occupant.subscriber->show_again(frame);
}

void Members::on_message(Seat& seat, SessionOccupant& occupant, const protocol::Respawn&) {
  if (refuse_when_busy(occupant)) return;
  game_.respawn(seat.louse);
  send(events_.respawned(game_.tick(), seat));
}

// ---- what they are shown -------------------------------------------------------------------------------

std::span<const InputMargin> Members::margins(std::uint64_t tick, Time begun) {
  acks_.take(tick, due_);
  margins_.clear();
  for (const PendingAck& ack : due_) {
    const auto late = static_cast<std::int64_t>(ack.ticks_late * 1'000'000 / game_.settings().tick_hz);
    const std::int64_t margin = duration_cast<microseconds>(begun - ack.arrived).count() - late;
    margins_.push_back({ack.player, ack.seq, margin});
  }
  return margins_;
}

void Members::answer(std::uint64_t tick, Time begun) {
  assert(tick + 1 == game_.tick());
  for (const PendingAck& pending : due_) {
    const Seat* seat = seats_.find(pending.session);
    if (!seat) continue;
    protocol::Ack ack;
    ack.seq = pending.seq - seat->first_seq;
    ack.tick = tick;
    ack.margin_us = duration_cast<microseconds>(begun - pending.arrived).count();
    ack.late = pending.late;
    ack.clamped = pending.clamped;
    if (const state::Louse* louse = game_.world().find(pending.player))
      ack.you = protocol::ExactState{game_.tick(), *louse};
    std::get<SessionOccupant>(seat->occupant).subscriber->answer(ack);
  }
  due_.clear();
  while (!leaving_.empty() && leaving_.begin()->first <= game_.tick())
    broadcaster_->let_go(leaving_.extract(leaving_.begin()).mapped());
}

std::uint64_t Members::ticks_a_frame() const { return game_.settings().tick_hz / settings_.state_hz; }

Scene Members::scene() const {
  return {game_.tick(),         game_.tick() / ticks_a_frame(),
          game_.world().lice(), game_.world().terrain(),
          game_.hash(),         game_.link()};
}

void Members::send_frames() {
  if (game_.tick() % ticks_a_frame() != 0 || channels_.empty()) return;
  const Scene now = scene();
  const FrameKind kind = now.index % settings_.state_hz == 0 ? FrameKind::kKey : FrameKind::kDelta;
  broadcaster_->frames(kind, channels_.encode(now, kind));
}

}  // namespace woodlouse::server
