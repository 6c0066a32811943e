// A room's events: what they say and how they are numbered, in one place.
// Pure. The room's strand owns it.
#pragma once

#include <cstdint>
#include <string>

#include "server/frames/frame.h"
#include "server/room/seats.h"
#include "shared/protocol/messages.h"
#include "shared/rules/rules.h"

namespace woodlouse::server {

struct NumberedLine {
  std::uint64_t number = 0;  ///< of the room's events, from 1, without holes
  Line line;
};

class Events {
 public:
  NumberedLine joined(std::uint64_t tick, const Seat& seat) {
    return make(tick, protocol::EventKind::kJoined, seat);
  }
  NumberedLine left(std::uint64_t tick, const Seat& seat) {
    return make(tick, protocol::EventKind::kLeft, seat);
  }
  NumberedLine respawned(std::uint64_t tick, const Seat& seat) {
    return make(tick, protocol::EventKind::kRespawned, seat);
  }
  NumberedLine chat(std::uint64_t tick, const Seat& seat, const std::string& text) {
    return make(tick, protocol::EventKind::kChat, seat, text);
  }

  /// What the rules said; name: of the louse's player, empty where it is nobody's.
  NumberedLine ruled(const rules::Event& event, const std::string& name, const rules::Rules& rules);

  /// Of a vote for the next game: so many by now, of so many that it takes.
  NumberedLine skip(std::uint64_t tick, const Seat& seat, std::size_t votes, std::size_t needed);

  /// What a watcher tells; it has no number yet.
  NumberedLine told(const protocol::Event& event) { return number(event); }

  /// Of the event made next.
  [[nodiscard]] std::uint64_t next() const { return next_; }

 private:
  NumberedLine make(std::uint64_t tick, protocol::EventKind kind, const Seat& seat,
                    const std::string& text = {});
  NumberedLine number(protocol::Event event);

  std::uint64_t next_ = 1;
};

}  // namespace woodlouse::server
