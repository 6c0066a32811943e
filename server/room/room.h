// One game: a strand, a timer on an absolute schedule, a match. Its ticks run in a context of their own, so
// that they never queue behind the sockets' work; frames and events leave through the outlet.
//
// A room in which nobody is stands still after kSleepAfter: no timer runs and no tick passes, until somebody
// joins. Nothing is made up for then: the next tick is the one that was due.
//
// A room with a rotation plays one game after the other: the next one is made beside the ticks when one is
// over, and begins between two of them for everybody who is here.
//
// One tick: bots look, the match steps, the watchers see the step, inputs are acknowledged, every
// tick_hz / state_hz ticks a picture of the lice is handed over.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>

#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/logging/events.h"
#include "server/room/door.h"
#include "server/room/members.h"
#include "server/room/rotation.h"
#include "server/room/start.h"
#include "server/stream/recorded_step.h"
#include "server/timing/clock.h"
#include "server/timing/figures.h"
#include "server/timing/next_tick.h"
#include "server/timing/posted_figures.h"
#include "server/timing/tick_clock.h"
#include "server/timing/timekeeper.h"
#include "shared/core/error.h"
#include "shared/core/joined.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

/// What it has posted keeps it until it ran.
class Room : public std::enable_shared_from_this<Room> {
 public:
  /// From the last moment on at which somebody was there, or a louse moved that is not the house's.
  static constexpr std::chrono::seconds kSleepAfter{10};
  /// For which joins are dealt with before a tick or others may run: a crowd at the door delays none.
  static constexpr std::chrono::milliseconds kDoorSlice{1};
  /// What counts as a round where there are no rules.
  static constexpr std::chrono::minutes kRoamRound{5};
  /// For which a game that is over goes on, that all hear its last events first.
  static constexpr std::chrono::seconds kLastWords{2};

  /// ticks: where the room's strand lives; lanes: where its members do; timekeeper: whose time its ticks
  /// keep; rotation: where its next games come from, null: it plays one for good. All outlive it.
  static std::shared_ptr<Room> make(boost::asio::io_context& ticks, const Lanes& lanes, RoomSettings settings,
                                    Start start, Watchers watchers, Timekeeper& timekeeper,
                                    std::shared_ptr<spdlog::logger> log, Rotation* rotation = nullptr);

  // Any thread. Calls of one thread take effect in their order.

  /// The first tick is due at the next whole millisecond. Before anybody joins a room that is watched: what a
  /// recording begins with has nobody on the way. ended: called once, on the room's strand, when the tick
  /// limit is reached.
  void start(std::function<void()> ended);
  /// Ends the ticks, says bye to the members, finishes the watchers' work; then calls `stopped`, on the
  /// room's strand. A room that has stopped takes nobody more; whoever stops it again only hears of its end.
  void stop(const protocol::Bye& bye, const std::string& reason, std::function<void()> stopped);
  /// No tick passes from now on, nobody comes in, and nobody is told: the game goes on elsewhere, and stop()
  /// follows. held: on the room's strand, once all that was played has been told to the watchers.
  void hold(std::function<void()> held);
  /// From now on these hold; who is here stays.
  void use(const protocol::Limits& limits) {
    boost::asio::post(strand_, [self = shared_from_this(), this, limits] {
      settings_.limits = limits;
      members_.renew_budgets(timekeeper_.now());
    });
  }
  /// What sessions hold. It does not keep the room.
  [[nodiscard]] std::shared_ptr<Door> door();

  // What an operator asks (room_orders.cpp). Any thread; answered once, on the room's strand.

  /// At which tick it was done, or why not.
  using Ordered = std::function<void(core::Expected<std::uint64_t> tick)>;
  void ask_roster(std::function<void(std::vector<RosterEntry>)> answered);
  /// To who is here now.
  void say(const protocol::Notice& notice);
  /// His chat is refused from now on, also when he has gone and comes back to his louse. lasts: none: as
  /// long as he is here.
  void mute(const RosterEntry& whom, std::optional<Duration> lasts);
  void unmute(const RosterEntry& whom);
  /// To who is here, and to whoever joins while it is so.
  void say_from_now_on(const protocol::Notice& notice);
  /// They come back no more: lice that nobody steers now go. put_out: told, on the room's strand, the
  /// sessions of those who are here, which are still to be ended.
  void put_out(std::vector<RosterEntry> entries, std::function<void(std::vector<SessionId>)> put_out);
  /// No tick passes from now on, whoever is here, till resume(). Nothing is made up for then.
  void pause(Ordered answered);
  void resume(Ordered answered);
  /// A paused room goes on for so many ticks, in its pace, and stands still again; then it is answered.
  void step(std::uint64_t ticks, Ordered answered);
  /// What a recording of the game would begin with, and which of the room's games that is.
  void ask_header(std::string_view build,
                  std::function<void(replay::Header header, std::uint64_t game)> answered);
  /// The recorder, of that header, watches from now on.
  void record(std::unique_ptr<TickWatcher> recorder, std::uint64_t game, Ordered answered);
  void end_recording(const std::string& reason, Ordered answered);
  [[nodiscard]] bool is_paused() const { return state_ == State::kPaused; }
  [[nodiscard]] bool is_recorded() const { return is_recorded_; }

  [[nodiscard]] const std::string& name() const { return settings_.name; }
  /// How many there are, as of now.
  [[nodiscard]] protocol::RoomEntry census() const { return members_.census(); }
  /// As of the last whole second of its ticks; as they ended, once it has stopped. Never null.
  [[nodiscard]] std::shared_ptr<const RoomFigures> figures() const { return figures_.now(); }
  /// What those who work beside the game find out while the room stands still is in them soon.
  void refresh_figures() {
    if (is_refresh_asked_.exchange(true)) return;
    boost::asio::post(strand_, [self = shared_from_this(), this] {
      is_refresh_asked_ = false;
      post_figures();
    });
  }
  /// None is due while the room stands still.
  [[nodiscard]] const NextTick& next_tick() const { return next_tick_; }

 private:
  class RoomDoor;
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;
  /// Joins that are not dealt with yet, and what their sessions have said since, in its order.
  struct Queue {
    std::deque<std::pair<SessionId, std::function<void()>>> jobs;
    std::map<SessionId, std::size_t> jobs_of;
    void push(SessionId session, std::function<void()> job) {
      jobs.emplace_back(session, std::move(job));
      ++jobs_of[session];
    }
    std::function<void()> pop() {
      assert(!jobs.empty());
      auto [session, job] = std::move(jobs.front());
      jobs.pop_front();
      const auto count = jobs_of.find(session);
      if (--count->second == 0) jobs_of.erase(count);
      return job;
    }
  };

  Room(boost::asio::io_context& ticks, const Lanes& lanes, RoomSettings settings, Start start,
       Watchers watchers, Timekeeper& timekeeper, std::shared_ptr<spdlog::logger> log, Rotation* rotation);

  void join(Arrival arrival);
  void admit(Arrival arrival);
  void vacate(SessionId session);
  void submit(SessionId session, protocol::ClientMessage message, Time arrived);
  void leave(SessionId session, Parting parting);

  template <typename Job>
  void in_order(SessionId session, Job job);
  void serve_the_door();

  void attach(TickWatcher& watcher);
  void begin_watching();
  void await_tick();
  void on_tick_due();
  void tick(Time now);
  [[nodiscard]] bool is_to_be_kept();
  void end_tick();
  void show();
  [[nodiscard]] bool is_to_sleep();
  void fall_asleep();
  void wake();
  [[nodiscard]] bool is_game_over() const;
  [[nodiscard]] bool is_next_ready();
  void begin_next();
  void finish(const Watchers& watchers, const std::string& reason, std::function<void()> finished);
  void end_if_finished();
  void stand_still();
  void go_on();
  void end_steps(core::Expected<std::uint64_t> tick);
  void look_for_recording();
  void begin_late();
  template <typename Order>
  void order(Ordered answered, Order carry_out);
  void post_figures();
  void say(LogEvent event, std::string_view text) const {
    log_event(*log_, event, core::joined({"room ", settings_.name, ": ", text}));
  }

  RoomSettings settings_;
  std::shared_ptr<spdlog::logger> log_;
  Strand strand_;
  Timekeeper& timekeeper_;
  std::unique_ptr<Alarm> alarm_;  ///< on the strand
  Rotation* rotation_;
  std::unique_ptr<match::Match> game_;
  std::unique_ptr<bots::Team> team_;  ///< until it has started
  Watchers watchers_;
  Members members_;
  // The strand's:
  Queue at_the_door_;
  std::optional<TickClock> clock_;
  /// What a tick has played, till it is shown.
  struct Unshown {
    Unshown(std::uint64_t of, Time at, const match::StepRecord& record, std::span<const InputMargin> margins)
        : number(of), due(at), step(record, margins) {}
    std::uint64_t number;
    Time due;  ///< begun
    Duration work{};
    bool is_over = false;  ///< the room has stood still since
    LiveStep step;
  };
  std::optional<Unshown> unshown_;  ///< between two ticks: a watcher keeps it first
  std::function<void()> ended_;
  enum class State { kWaiting, kRunning, kAsleep, kPaused, kStopped };
  std::atomic<State> state_ = State::kWaiting;  ///< any thread may look
  std::uint64_t deserted_ticks_ = 0;            ///< in a row
  std::uint64_t games_ = 1;                     ///< begun, this one too
  std::uint64_t former_ticks_ = 0;              ///< of all games but this one
  std::uint64_t over_ticks_ = 0;                ///< since this one was over, and the next one was there
  bool is_next_asked_ = false;
  std::optional<NextGame> next_;
  struct FormerGame {
    std::unique_ptr<match::Match> game;
    Watchers watchers;
  };
  std::list<FormerGame> former_;  ///< whose watchers have not finished yet
  bool is_held_ = false;
  bool has_finished_ = false;  ///< stopped, and so have the watchers of this one
  RoomFigures working_;
  std::string map_file_;          ///< of the game, for its recordings
  std::uint64_t steps_left_ = 0;  ///< until it stands still again; 0: it goes on
  Ordered stepped_;               ///< who waits for that
  std::atomic<bool> is_recorded_ = false;
  std::unique_ptr<TickWatcher> late_;  ///< begins once nothing is queued in the game: behind the next step
  std::vector<std::function<void()>> awaiting_end_;  ///< who asked for the stop
  bool has_ended_ = false;

  // Any thread's:
  PostedFigures figures_;
  NextTick next_tick_;
  std::atomic<bool> is_refresh_asked_{false};
};

}  // namespace woodlouse::server
