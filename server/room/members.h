// Who is in a room and what passes between them and the game: joins and leaves, messages in; frames, events
// and answers out. The room's clock says when. The room's strand owns it.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/room/broadcaster.h"
#include "server/room/channels.h"
#include "server/room/clock.h"
#include "server/room/events.h"
#include "server/room/pending_acks.h"
#include "server/room/seats.h"
#include "server/room/tick_watcher.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

struct RoomSettings {
  std::string name;
  std::uint32_t state_hz = 20;              ///< divides the match's tick_hz
  std::uint32_t bots = 0;                   ///< of the house
  bool bots_alone_play = false;             ///< the house's bots keep a room awake in which nobody is
  std::optional<std::uint64_t> tick_limit;  ///< ends after so many
  std::uint32_t per_room = 1024;            ///< sessions at most, the house's bots apart
};

using Watchers = std::vector<std::unique_ptr<TickWatcher>>;

class Members {
 public:
  /// io: where events and frames are handed out. settings, game and watchers outlive it.
  Members(boost::asio::io_context& io, const RoomSettings& settings, match::Match& game,
          const Watchers& watchers, std::vector<Seat> unclaimed, std::shared_ptr<spdlog::logger> log);

  void add_house_bots();  ///< once, before the first tick
  /// The house's bots look and push, each ten times a second.
  void steer_house_bots();

  void admit(SessionId session, std::shared_ptr<Subscriber> subscriber, const protocol::Join& join);
  static void refuse_closed(Subscriber& subscriber);
  void remove(SessionId session);
  void take(SessionId session, const protocol::ClientMessage& message, Time arrived);
  void announce(const protocol::Notice& notice);
  /// Says bye to every session; they are members no more.
  void dismiss(const protocol::Bye& bye);

  /// How long before step `tick`, begun at `begun`, its inputs came; then answer() tells them.
  std::span<const InputMargin> margins(std::uint64_t tick, Time begun);
  void answer(std::uint64_t tick, Time begun);
  /// The picture of every layout in use, where one is due.
  void send_frames();

  /// No session is here, and nothing goes on that somebody began.
  [[nodiscard]] bool is_deserted();

  /// Any thread.
  [[nodiscard]] protocol::RoomEntry census() const;
  [[nodiscard]] std::uint64_t frames_encoded() const { return channels_.encoded(); }

 private:
  [[nodiscard]] std::optional<protocol::ErrorMessage> why_not() const;
  void give_louse(Seat& seat);
  [[nodiscard]] protocol::Welcome welcome_for(const Seat& seat, std::uint32_t state_hz) const;
  void on_message(Seat& seat, SessionOccupant& occupant, const protocol::Input& input, Time arrived);
  void on_message(Seat& seat, SessionOccupant& occupant, const protocol::Chat& chat);
  void on_message(Seat& seat, const SessionOccupant& occupant, const protocol::Leave&);
  void on_message(Seat& seat, SessionOccupant& occupant, const protocol::GetMap&);
  void on_message(Seat& seat, SessionOccupant& occupant, const protocol::Resync&);
  void on_message(Seat& seat, SessionOccupant& occupant, const protocol::Respawn&);
  void drop_input(SessionOccupant& occupant, const protocol::Input& input, const match::Filed& filed);
  [[nodiscard]] bool refuse_when_busy(SessionOccupant& occupant) const;
  void send(const NumberedLine& event) { broadcaster_->event(event.number, event.line); }
  void count(protocol::Role role, std::int32_t change);
  [[nodiscard]] Scene scene() const;
  [[nodiscard]] std::uint64_t ticks_a_frame() const;

  const RoomSettings& settings_;
  match::Match& game_;
  const Watchers& watchers_;
  std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<Broadcaster> broadcaster_;
  Line map_line_;
  std::atomic<std::uint32_t> players_{0}, bots_{0}, spectators_{0};
  Seats seats_;
  PendingAcks acks_;
  // Of the step that margins() was asked for:
  std::vector<PendingAck> due_;
  std::vector<InputMargin> margins_;
  std::multimap<std::uint64_t, SessionId>
      leaving_;  ///< by the tick from which on all their inputs are acknowledged
  Channels channels_;
  Events events_;
  std::vector<std::vector<Seat*>> bots_by_turn_;  ///< the house's, by the tick of a period at which they look
};

}  // namespace woodlouse::server
