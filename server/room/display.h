// What the members of a room are shown of its game: its map, frames in the layouts that are in use, a
// welcome. The room's strand owns it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "server/frames/layouts.h"
#include "server/frames/snapshot.h"
#include "server/room/door.h"
#include "server/room/outlet.h"
#include "server/room/room_settings.h"
#include "server/room/seats.h"
#include "server/room/welcome.h"
#include "server/stream/recorded_step.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Who is there, for a welcome.
struct Company {
  std::vector<protocol::PlayerEntry> players;
  std::uint32_t spectators = 0;
};

class Display {
 public:
  /// settings and outlet outlive it, a game until the next one begins.
  Display(const RoomSettings& settings, const match::Match& game, Outlet& outlet);

  /// The seat gets its channel, and its session the welcome and the newest frames, but no more till
  /// subscribe(). REQUIRES that the seat is that session's.
  void welcome(Seat& seat, const Arrival& arrival, bool is_back, Company company);
  /// From now on it has every frame, and the events from that one on.
  void subscribe(const SessionOccupant& occupant, std::uint64_t first_event);
  void unsubscribe(const SessionOccupant& occupant);
  /// Whether the game can be watched by inputs: its map is sent whole.
  [[nodiscard]] bool has_inputs() const;
  /// Another game: who is seated is welcomed to it, behind all frames of the one before.
  void begin(const match::Match& game, Seats& seats, Company company);
  /// The same game, in another match at the same tick or a later one; the former one is here no more, but its
  /// map, until the outlet has done what it was asked.
  void go_on(const match::Match& game);

  void show_newest(const SessionOccupant& occupant) {
    if (keeps_) return void(later_.insert(occupant.session));
    if (occupant.channel == kByInputs) return ask({occupant.subscriber, false});
    outlet_.show_newest(occupant.channel, occupant.subscriber, snapshot());
  }
  void show_map(const SessionOccupant& occupant) const { occupant.subscriber->deliver_map(map_line_); }
  /// It is shown all, or a part, from the next key on: a client has no two keys of one tick that differ.
  void look(SessionId session, const protocol::View& view) { turning_[session] = shows_part(view); }
  /// The picture of every layout in use, where one is due.
  void send_frames(Seats& seats);
  /// What the game is now is not to be seen before end_keeping(); who asks for it meanwhile is shown it then.
  void begin_keeping() { keeps_ = true; }
  void end_keeping(Seats& seats);
  /// No step follows for now: all are shown where the game stands, and who asks for a keyframe meanwhile gets
  /// it at once.
  void stand(Seats& seats);
  /// The step just done, to who watches by inputs, and a keyframe to who has asked for one since. REQUIRES
  /// that nothing is queued in the match.
  void show_step(const LiveStep& step);

 private:
  [[nodiscard]] bool shows_part(const protocol::View& view) const {
    return !view.is_whole() || settings_.limits.frame_rows < protocol::kEveryRow;
  }
  void turn(Seat& seat, bool shows_part);
  /// Who is to get a keyframe behind the next step.
  struct Asked {
    std::shared_ptr<Subscriber> subscriber;
    bool wants_header = false;
  };
  void ask(Asked asked) {
    asked_.push_back(std::move(asked));
    if (stands_) answer_asked();
  }
  void answer_asked();
  void choose(Seat& seat, const RowLayout& rows);
  [[nodiscard]] Addressee addressee(const Seat& seat) const;
  void show_first(const SessionOccupant& occupant);
  void change_over(Seat& seat, SessionOccupant& occupant);
  [[nodiscard]] const Line& header();
  [[nodiscard]] protocol::Welcome welcome_to_all(Company company) const;
  [[nodiscard]] SharedSnapshot snapshot();
  [[nodiscard]] std::uint64_t ticks_a_frame() const;

  const RoomSettings& settings_;
  const match::Match* game_;
  Outlet& outlet_;
  Line map_line_;
  Layouts layouts_;
  std::map<SessionId, bool> turning_;  ///< with the next key, to a part or to all
  SharedPool<Snapshot> snapshots_;
  SharedSnapshot snapshot_;  ///< of its tick, for all who ask within that
  Line header_;              ///< of the game's recording, once somebody watches by inputs
  std::vector<Asked> asked_;
  bool stands_ = false;                         ///< no step is on its way
  bool keeps_ = false;                          ///< what was played is not to be seen yet
  std::set<SessionId> later_;                   ///< who is to see it then
  std::size_t by_inputs_ = 0;                   ///< how many are subscribed
  std::optional<std::uint64_t> keyframe_tick_;  ///< of the one that the outlet keeps
};

}  // namespace woodlouse::server
