// What a session may ask of a room. The room behind it may close while the door is held; then the door says
// so.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "server/frames/layouts.h"
#include "server/room/subscriber.h"
#include "server/timing/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Who asks to be let in.
struct Arrival {
  SessionId session = 0;
  std::shared_ptr<Subscriber> subscriber;
  protocol::Join join;
  AddressId address = 0;
  Time at{};            ///< when its line was read
  bool is_web = false;  ///< by the web port
  /// What he is told where no louse here is his; none: he gets one.
  std::optional<protocol::ErrorMessage> unless_back{};
};

enum class Parting {
  kLeft,  ///< for good
  kLost,  ///< the connection ended: who asked for it may come back to its louse
};

/// Any thread; calls of one thread take effect in their order. Every call returns at once.
class Door {
 public:
  Door() = default;
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;
  virtual ~Door() = default;

  /// Answered by welcome() and frames, or refuse_join().
  virtual void join(Arrival arrival) = 0;
  /// A message of a session that asked to join. arrived: when its line was read.
  virtual void submit(SessionId session, protocol::ClientMessage message, Time arrived) = 0;
  /// The session says nothing any more, though it is connected: its thrust ends.
  virtual void vacate(SessionId session) = 0;
  /// The session is gone: its thrust ends, and its louse goes or waits.
  virtual void leave(SessionId session, Parting parting) = 0;

  /// The room is played elsewhere: nobody who plays is to come in here.
  [[nodiscard]] virtual bool only_shows() const { return false; }
  /// Never changes.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// How many there are, as of now.
  [[nodiscard]] virtual protocol::RoomEntry census() const = 0;
};

}  // namespace woodlouse::server
