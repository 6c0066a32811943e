// Where a room takes inputs: files them with the match under its own count, and answers each once its step
// has run. Pure. The room's strand owns it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/room/pending_acks.h"
#include "server/room/room_settings.h"
#include "server/room/seats.h"
#include "server/room/tick_watcher.h"
#include "server/timing/clock.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

class InputDesk {
 public:
  /// All three outlive it.
  InputDesk(const RoomSettings& settings, match::Match& game, Seats& seats)
      : settings_(settings), game_(game), seats_(seats) {}

  /// An input of a session: its ack comes with its step, or now with the reason why it is dropped.
  void file(Seat& seat, SessionOccupant& occupant, const protocol::Input& input, Time arrived);
  /// Its player is not there to steer: what waits is dropped, and the thrust ends. REQUIRES a louse.
  void stop(Seat& seat);

  /// How long before step `tick`, begun at `begun`, its inputs came; then answer() tells them.
  std::span<const InputMargin> margins(std::uint64_t tick, Time begun);
  void answer(std::uint64_t tick, Time begun);

 private:
  void drop(SessionOccupant& occupant, const protocol::Input& input, const match::Filed& filed);
  void replace(SessionOccupant& occupant, const match::Filed& filed, const PendingAck& newer);

  const RoomSettings& settings_;
  match::Match& game_;
  Seats& seats_;
  PendingAcks acks_;
  // Of the step that margins() was asked for:
  std::vector<PendingAck> due_;
  std::vector<InputMargin> margins_;
};

}  // namespace woodlouse::server
