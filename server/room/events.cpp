#include "server/room/events.h"

#include <cassert>
#include <string>
#include <utility>

#include "server/room/shown_game.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server {

NumberedLine Events::make(std::uint64_t tick, protocol::EventKind kind, const Seat& seat,
                          const std::string& text) {
  protocol::Event event;
  event.tick = tick;
  event.kind = kind;
  event.id = seat.louse;
  event.name = seat.name;
  event.role = seat.role;
  event.text = text;
  return number(std::move(event));
}

NumberedLine Events::number(protocol::Event event) {
  event.n = next_++;
  return {event.n, Line(protocol::encode(std::move(event)))};
}

NumberedLine Events::skip(std::uint64_t tick, const Seat& seat, std::size_t votes, std::size_t needed) {
  assert(votes >= 1 && needed >= 1);
  protocol::Event event;
  event.tick = tick;
  event.kind = protocol::EventKind::kSkip;
  event.id = seat.louse;
  event.name = seat.name;
  event.moment = tick * rules::kMomentsPerTick;
  event.values = {static_cast<std::int64_t>(votes), static_cast<std::int64_t>(needed)};
  return number(std::move(event));
}

NumberedLine Events::ruled(const rules::Event& ruling, const std::string& name, const rules::Rules& rules) {
  assert(ruling.louse != 0 || name.empty());
  protocol::Event event = shown_event(ruling, rules);
  event.name = name;
  return number(std::move(event));
}

}  // namespace woodlouse::server
