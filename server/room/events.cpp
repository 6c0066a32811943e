#include "server/room/events.h"

#include <utility>

#include "shared/protocol/codec.h"

namespace woodlouse::server {

NumberedLine Events::make(std::uint64_t tick, protocol::EventKind kind, const Seat& seat,
                          const std::string& text) {
  const std::uint64_t number = next_++;
  protocol::Event event{number, tick, kind, seat.louse, seat.name, seat.role, text};
  return {number, Line(protocol::encode(std::move(event)))};
}

}  // namespace woodlouse::server
