// A second match beside a room's own: it re-runs each tick from what the recorder gets, on a thread of its
// own, and compares. Where the two differ, something is broken (a flag, a compiler, the memory): it is
// counted, told once, loudly, and both states are kept in files. Never slows the game: a shadow that falls
// kMaxQueued steps behind is ended with one log line.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "server/room/tick_watcher.h"
#include "server/timing/clock.h"
#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/replay/rerun.h"

namespace woodlouse::server {

/// It outlives what it posted to the pool.
class Shadow final : public TickWatcher {
 public:
  static constexpr std::size_t kMaxQueued = 300;  ///< steps waiting: 5 s at 60 Hz
  /// How long finish() goes on with steps that wait; what is left then is not compared.
  static constexpr std::chrono::milliseconds kFinishWithin{300};

  /// header: of the game that it will watch. dump: of a difference at tick 812 the game's side is written to
  /// DUMP.812.game.ndjson, its shadow's to DUMP.812.shadow.ndjson.
  Shadow(std::string room, std::shared_ptr<const map::Map> map, replay::Header header,
         std::filesystem::path dump, boost::asio::thread_pool& pool, std::shared_ptr<spdlog::logger> log);

  void begin(const match::Match& game) override;
  void step(const LiveStep& step, const match::Match& game) override;
  /// `done` is called on the shadow's thread.
  void finish(const std::string& reason, std::function<void()> done) override;
  void add_figures(RoomFigures& figures) const override;

 private:
  void compare(const match::StepRecord& record, match::MatchState game);
  void tell(const match::StepRecord& record, const match::MatchState& game, const std::string& what);
  core::Expected<void> follow(match::MatchState game);
  [[nodiscard]] core::Expected<std::string> dump_side(const char* side, const match::StepRecord& record,
                                                      const match::MatchState& after) const;
  void end(const std::string& why);

  std::string room_;
  std::shared_ptr<const map::Map> map_;
  std::filesystem::path dump_;
  boost::asio::strand<boost::asio::thread_pool::executor_type> strand_;
  std::shared_ptr<spdlog::logger> log_;
  std::atomic<std::size_t> queued_{0};
  std::atomic<bool> ended_{false};
  std::atomic<std::uint64_t> ticks_{0};
  std::atomic<std::uint64_t> differences_{0};
  std::atomic<Time> finish_by_{Time::max()};
  // The strand's:
  replay::Header header_;
  std::unique_ptr<replay::Rerun> rerun_;
  match::MatchState before_;  ///< the game's, of the tick where rerun_ stands
};

}  // namespace woodlouse::server
