// Where a room's games come from, if it plays one after the other.
#pragma once

#include <functional>

#include "server/room/start.h"
#include "server/room/tick_watcher.h"

namespace woodlouse::server {

struct NextGame {
  Start start;
  Watchers watchers;
};

class Rotation {
 public:
  Rotation() = default;
  Rotation(const Rotation&) = delete;
  Rotation& operator=(const Rotation&) = delete;
  virtual ~Rotation() = default;

  /// Makes the game after the one that was asked for last, of the same tick rate, which may take long:
  /// `ready` is called with it once, on some thread; not at all after the server's end. Returns at once; any
  /// thread.
  virtual void prepare(std::function<void(NextGame)> ready) = 0;
};

}  // namespace woodlouse::server
