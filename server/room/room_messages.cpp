// What members say to a room, and who may be one.
#include <boost/asio/post.hpp>

#include <type_traits>
#include <utility>
#include <variant>

#include "server/room/room.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace code = protocol::code;

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

void Room::submit(SessionId session, protocol::ClientMessage message, Time arrived) {
  boost::asio::post(strand_, [this, session, message = std::move(message), arrived] {
    Member* member = roster_.find(session);
    // The room refused its join, which it has been told, or it has left since.
    if (!member) return;
    std::visit(
        [&](const auto& m) {
          using Message = std::decay_t<decltype(m)>;
          if constexpr (std::is_same_v<Message, protocol::Input>)
            on_message(session, *member, m, arrived);
          else if constexpr (requires { on_message(*member, m); })
            on_message(*member, m);
        },
        message);
  });
}

std::optional<protocol::ErrorMessage> Room::why_not() const {
  if (state_ == State::kStopped) return error(code::kShutdown, "join: the room has closed");
  if (roster_.members.size() >= settings_.per_room)
    return error(code::kRoomFull, "join: room " + settings_.name + " is full (" +
                                      std::to_string(settings_.per_room) +
                                      "); try again later or another room");
  if (broadcaster_.backlog() > Broadcaster::kMaxBacklog)
    return error(code::kRateLimited, "join: too much is happening in room " + settings_.name, 1000);
  return std::nullopt;
}

void Room::admit(SessionId session, std::shared_ptr<Subscriber> subscriber, const protocol::Join& join) {
  if (auto refusal = why_not()) return subscriber->refuse_join(std::move(*refusal));
  const auto channel = channels_.acquire({join.fields, join.format});
  if (!channel)
    return subscriber->refuse_join(
        error(code::kBadField, "join.fields: this room serves " + std::to_string(FrameChannels::kMaxLayouts) +
                                   " different choices of fields and format already; leave `fields` out"));
  Member member{std::move(subscriber), join.name, join.role, 0, *channel, 0};
  const std::uint32_t state_hz = granted_state_hz(join.state_hz, settings_.state_hz);
  if (join.role != protocol::Role::kSpectator) {
    member.louse = give_louse(member);
    if (recorder_) recorder_->player(member.louse, member.name, member.role);
  }
  member.subscriber->welcome(welcome_for(member, join, state_hz), settings_.state_hz / state_hz);
  for (const Frame& frame : channels_.newest(*channel, scene())) member.subscriber->show_again(frame);
  broadcaster_.add({session, member.subscriber, *channel, next_event_});
  count(member.role, +1);
  const Member& added = roster_.members.emplace(session, std::move(member)).first->second;
  log_->info("room {}: session {:016x} joined as {} {} \"{}\"", settings_.name, session, to_text(added.role),
             added.louse, added.name);
  emit({0, 0, protocol::EventKind::kJoined, added.louse, added.name, added.role, {}});
}

match::PlayerId Room::give_louse(Member& member) {
  const std::optional<Orphan> taken = roster_.take_over(member.name);
  if (!taken) return match_.join();
  member.first_seq = taken->first_seq;
  log_->info("room {}: \"{}\" takes over louse {} of the recording", settings_.name, member.name,
             taken->louse);
  return taken->louse;
}

protocol::Welcome Room::welcome_for(const Member& member, const protocol::Join& join,
                                    std::uint32_t state_hz) const {
  const map::Map& map = match_.map();
  const terrain::Rectangle& domain = map.terrain->domain();
  protocol::Welcome welcome;
  welcome.id = member.louse;
  welcome.room = settings_.name;
  welcome.tick = match_.tick();
  welcome.tick_hz = tick_hz_;
  welcome.state_hz = state_hz;
  welcome.fields = join.fields;
  welcome.format = join.format;
  welcome.map_name = map.definition.name;
  welcome.map_hash = map.hash;
  welcome.extent = {domain.x_min, domain.y_min, domain.x_max, domain.y_max};
  welcome.map_bytes = map_line_->size();
  welcome.physics = map.definition.physics;
  welcome.mode = "roam";
  welcome.players = roster_.entries();
  return welcome;
}

void Room::remove(SessionId session) {
  auto node = roster_.members.extract(session);
  if (node.empty()) return;
  const Member& member = node.mapped();
  if (member.louse != 0) match_.leave(member.louse);
  channels_.release(member.channel);
  broadcaster_.remove(session);
  count(member.role, -1);
  log_->info("room {}: session {:016x} left ({} {})", settings_.name, session, to_text(member.role),
             member.louse);
  emit({0, 0, protocol::EventKind::kLeft, member.louse, member.name, member.role, {}});
}

void Room::on_message(SessionId session, Member& member, const protocol::Input& input, Time arrived) {
  const std::uint32_t seq = member.first_seq + input.seq;
  const match::Filed filed = match_.file(
      {member.louse, seq, input.thrust, input.ticks.value_or(state::kHeld), input.tick.value_or(0)});
  if (filed.outcome != match::Filed::Outcome::kFiled) return drop_input(member, input, filed);
  const std::uint64_t ticks_late = filed.late ? filed.tick - input.tick.value_or(filed.tick) : 0;
  acks_.add(filed.tick, {session, member.louse, seq, arrived, filed.late, input.clamped, ticks_late});
}

void Room::drop_input(Member& member, const protocol::Input& input, const match::Filed& filed) {
  const std::string where = "input " + std::to_string(input.seq) + " dropped: ";
  switch (filed.outcome) {
    case match::Filed::Outcome::kFiled:
      return;
    case match::Filed::Outcome::kStaleSeq:
      member.subscriber->answer(
          error(code::kStaleSeq, where + "seq must be above that of every input before"));
      break;
    case match::Filed::Outcome::kQueueFull:
      member.subscriber->answer(error(
          code::kQueueFull,
          where + std::to_string(match::InputQueue::kMaxPending) + " of your inputs wait for their tick"));
      break;
    case match::Filed::Outcome::kTooFar:
      member.subscriber->answer(error(code::kTooFar, where + "tick " + std::to_string(filed.tick) +
                                                         " is more than 2 s after the present " +
                                                         std::to_string(match_.tick())));
      break;
    case match::Filed::Outcome::kNoLouse:
      member.subscriber->answer(error(code::kNoLouse, where + "you have no louse"));
      break;
  }
  protocol::Ack ack;
  ack.seq = input.seq;
  ack.tick = match_.tick();
  ack.late = filed.late;
  ack.dropped = true;
  ack.clamped = input.clamped;
  member.subscriber->answer(ack);
}

bool Room::refuse_when_busy(Member& member) const {
  if (broadcaster_.backlog() <= Broadcaster::kMaxBacklog) return false;
  member.subscriber->answer(error(code::kRateLimited, "too much is happening in this room", 1000));
  return true;
}

void Room::on_message(Member& member, const protocol::Chat& chat) {
  if (refuse_when_busy(member)) return;
  if (recorder_) recorder_->chat(match_.tick(), member.louse, member.name, chat.text);
  emit({0, 0, protocol::EventKind::kChat, member.louse, member.name, member.role, chat.text});
}

void Room::on_message(Member& member, const protocol::GetMap&) { member.subscriber->deliver_map(map_line_); }

void Room::on_message(Member& member, const protocol::Resync&) {
  for (const Frame& frame : channels_.newest(member.channel, scene())) member.subscriber->show_again(frame);
}

void Room::on_message(Member& member, const protocol::Respawn&) {
  if (refuse_when_busy(member)) return;
  match_.respawn(member.louse);
  emit({0, 0, protocol::EventKind::kRespawned, member.louse, member.name, member.role, {}});
}

void Room::emit(protocol::Event event) {
  event.n = next_event_++;
  event.tick = match_.tick();
  const std::uint64_t number = event.n;
  broadcaster_.event(number, std::make_shared<const std::string>(protocol::encode(std::move(event))));
}

}  // namespace woodlouse::server
