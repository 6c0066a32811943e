// What a session may ask of a room. The room behind it may close while the door is held; then the door says
// so.
#pragma once

#include <string>

#include "server/room/clock.h"
#include "server/room/subscriber.h"
#include "shared/protocol/messages.h"

#include <memory>

namespace woodlouse::server {

/// Any thread; calls of one thread take effect in their order. Every call returns at once.
class Door {
 public:
  Door() = default;
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;
  virtual ~Door() = default;

  /// Answered by welcome() and frames, or refuse_join().
  virtual void join(SessionId session, std::shared_ptr<Subscriber> subscriber, protocol::Join join) = 0;
  /// A message of a session that asked to join. arrived: when its line was read.
  virtual void submit(SessionId session, protocol::ClientMessage message, Time arrived) = 0;
  /// The session is gone: its thrust ends and its louse goes.
  virtual void leave(SessionId session) = 0;

  /// Never changes.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// How many there are, as of now.
  [[nodiscard]] virtual protocol::RoomEntry census() const = 0;
};

}  // namespace woodlouse::server
