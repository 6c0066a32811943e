// Which rooms there are, as a session sees them; the lobby is one.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/room/door.h"
#include "server/timing/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Any thread.
class Directory {
 public:
  Directory() = default;
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  virtual ~Directory() = default;

  /// The door of that name, the first one for an empty name, or null.
  [[nodiscard]] virtual std::shared_ptr<Door> find(std::string_view name) const = 0;
  [[nodiscard]] virtual std::vector<std::string> names() const = 0;
  [[nodiscard]] virtual protocol::Rooms list() const = 0;
  /// Whether the next tick of one of them has been due for longer than passes by itself
  /// (timing/next_tick.h).
  [[nodiscard]] virtual bool is_too_late(Time now) const = 0;
};

}  // namespace woodlouse::server
