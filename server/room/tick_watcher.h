// Who works beside a room's game and sees every tick of it: a recording, a second run that compares, tiles
// built ahead. It learns all that a re-run needs, and changes nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/access/claim.h"
#include "server/frames/line.h"
#include "server/stream/recorded_step.h"
#include "server/timing/figures.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// The room's strand calls it, in this order: attach(), begin(), then claimed(), chat(), step() and rest() as
/// they happen, fall_asleep() and wake() around a time in which no tick passes, finish(). Every call returns
/// at once.
class TickWatcher {
 public:
  /// Tells every session of the room, those that join later too; any thread.
  using Announce = std::function<void(const protocol::Notice&)>;
  /// Tells those who are in the room, as one of its events, which the room numbers; any thread.
  using Tell = std::function<void(const protocol::Event&)>;

  TickWatcher() = default;
  TickWatcher(const TickWatcher&) = delete;
  TickWatcher& operator=(const TickWatcher&) = delete;
  virtual ~TickWatcher() = default;

  /// First of all, once: whom it may tell.
  virtual void attach(Announce /*announce*/) {}
  virtual void attach_events(Tell /*tell*/) {}
  /// Once. `game`: as it stands; nothing is queued in it.
  virtual void begin(const match::Match& game) = 0;
  virtual void chat(std::uint64_t /*tick*/, match::PlayerId /*player*/, const std::string& /*name*/,
                    const std::string& /*text*/) {}
  /// Somebody may come back to his louse by a token: who could already follows begin(), others as they come.
  /// The louse joins with the next step at the latest; what it leads to ends when the louse leaves.
  virtual void claimed(const Claim& /*claim*/) {}
  /// After the step. `game`: as the step left it, nothing queued since.
  virtual void step(const LiveStep& /*step*/, const match::Match& /*game*/) {}
  /// Behind step(). True: nobody is shown the step, nor told of it, and no further one is played, before
  /// `kept` is called, on any thread; of all watchers of a room one at most asks for it.
  [[nodiscard]] virtual bool await_kept(const std::function<void()>& /*kept*/) { return false; }
  /// Whether this game is still the room's, as far as is known: what no longer is, is shown to nobody. Behind
  /// step() and, where that was asked for, its keeping.
  [[nodiscard]] virtual bool may_show() { return true; }
  /// After everything else of the tick is done: who is in the room was answered and shown it.
  virtual void rest(const match::Match& /*game*/) {}
  /// The room stands still, as nobody is there, or its operator has paused it. Nothing follows but chat(),
  /// wake() or finish().
  virtual void fall_asleep(const match::Match& /*game*/) {}
  /// The next step follows.
  virtual void wake(const match::Match& /*game*/) {}
  /// The line that answers a list_records or get_ghost; none: it has no such thing.
  [[nodiscard]] virtual Line answer(const protocol::ClientMessage& /*question*/) const { return {}; }
  /// Last of all, once; `done` is called when its work is done, on some thread. It outlives that call.
  virtual void finish(const std::string& reason, std::function<void()> done) = 0;

  /// It writes what happens, as long as it can.
  [[nodiscard]] virtual bool is_recording() const { return false; }
  /// Adds its own figures to the room's.
  virtual void add_figures(RoomFigures& /*figures*/) const {}
};

/// Those of a game.
using Watchers = std::vector<std::unique_ptr<TickWatcher>>;

}  // namespace woodlouse::server
