// A room that is played at another server and shown here: its log's lines are re-run, each tick is proven,
// and who watches is shown frames, events and inputs as he would be there, a batch later. Nothing that is
// said here reaches the room.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/strand.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/relay/playout.h"
#include "server/room/display.h"
#include "server/room/door.h"
#include "server/room/events.h"
#include "server/room/lanes.h"
#include "server/room/outlet.h"
#include "server/room/places.h"
#include "server/room/room_settings.h"
#include "server/room/seats.h"
#include "server/timing/live_limits.h"
#include "server/timing/timekeeper.h"
#include "shared/follow/follower.h"

namespace woodlouse::server {

/// Held by a shared_ptr: what it has posted keeps it until it ran.
class RelayRoom final : private follow::Witness, public std::enable_shared_from_this<RelayRoom> {
 public:
  /// Without a line, all of the last one is shown and nothing more is expected.
  static constexpr std::chrono::milliseconds kStandsAfter{400};
  /// For which lines are re-run before others may run.
  static constexpr std::chrono::milliseconds kSlice{2};
  /// Lines that wait, of a step or more each; beyond, those that were not shown are re-run at once.
  static constexpr std::size_t kMostWaiting = 1200;

  struct Hooks {
    std::function<void()> ready;  ///< there is something to be shown, once
    std::function<void(const std::string& why)>
        lost;  ///< it shows nothing any more, once; who was here is gone
  };

  /// ticks: where its strand lives; delay: Playout's; hooks: called on the room's strand; maps: those of the
  /// rooms beside it. All outlive it.
  RelayRoom(boost::asio::io_context& ticks, const Lanes& lanes, RoomSettings settings,
            const LiveLimits& limits, Duration delay, Timekeeper& timekeeper, replay::Maps& maps,
            Hooks hooks);

  // Any thread; calls of one thread take effect in their order:

  /// What the log tells of the room next, lines without their newlines. What is here already is passed over.
  void take(std::vector<std::string> lines);
  /// It is over, as its own server says.
  void close(const protocol::Bye& bye);

  /// What sessions hold. It does not keep the room.
  [[nodiscard]] std::shared_ptr<Door> door();

  [[nodiscard]] const std::string& name() const { return settings_.name; }
  [[nodiscard]] protocol::RoomEntry census() const;
  /// Ticks that were re-run here and gave the hash of the log.
  [[nodiscard]] std::uint64_t proven() const { return proven_.load(std::memory_order_relaxed); }

 private:
  class RelayDoor;
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;

  void began(const match::Match& game) override;
  void stepped(const match::StepRecord& step, const match::Match& game) override;
  void said(const replay::ChatLine& chat) override;

  void play();
  void ring(Time when);
  void rerun(const std::string& line);
  void lose(const std::string& why);
  void dismiss(const protocol::Bye& bye);
  void join(Arrival arrival);
  void submit(SessionId session, protocol::ClientMessage message);
  void leave(SessionId session);
  void admit(Arrival arrival);
  [[nodiscard]] std::optional<protocol::ErrorMessage> why_not(const Arrival& arrival) const;
  void take_from(SessionId session, const protocol::ClientMessage& message);
  [[nodiscard]] Company company() const;
  void tell(const match::RosterChange& change, std::uint64_t tick);
  void send(const NumberedLine& event) { outlet_->event(event.number, event.line); }
  void count();

  RoomSettings settings_;
  const LiveLimits& limits_;
  const Duration delay_;
  Strand strand_;
  Timekeeper& timekeeper_;
  const Hooks hooks_;
  // The strand's:
  std::unique_ptr<Alarm> alarm_;
  std::deque<std::string> lines_;  ///< not re-run yet
  std::string header_;             ///< of the game that the lines are of
  bool is_header_new_ = false;     ///< the follower has not read it yet: it does with the next keyframe
  bool is_playing_ = false;        ///< a slice is posted
  bool stands_ = true;
  bool is_over_ = false;
  follow::Follower follower_;
  std::shared_ptr<const map::Map> map_;  ///< of what is shown
  std::shared_ptr<Outlet> outlet_;
  std::optional<Playout> playout_;
  std::optional<Display> display_;  ///< once there is a game
  Seats seats_{{}};
  Places places_;
  Events events_;
  match::PlayerLabels who_;    ///< has a louse, as last told
  match::MatchSettings game_;  ///< of the game that is shown
  std::uint64_t shown_ = 0;    ///< its tick
  // Any thread's:
  mutable std::mutex mutex_;  ///< of what follows
  std::string map_name_;
  std::atomic<std::uint32_t> players_{0}, bots_{0}, spectators_{0};
  std::atomic<std::uint64_t> proven_{0};
};

}  // namespace woodlouse::server
