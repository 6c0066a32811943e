// Writes a recording while the game runs. Lines are made, packed and written on the disk's own thread; the
// tick hands over values and goes on. What happened is in the file at most a second later, also when nothing
// more happens. A disk that fails or falls kMaxQueued steps behind ends the recording with one loud log line
// and a word to the room, never the game.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/room/tick_watcher.h"
#include "shared/core/byte_sink.h"
#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/replay/writer.h"

namespace woodlouse::server {

/// One recording. Everything but open() returns at once.
class Recorder final : public TickWatcher {
 public:
  static constexpr std::size_t kMaxQueued = 1200;  ///< jobs waiting for the disk: 20 s of steps at 60 Hz
  /// Half of what a killed server may lose, so that a busy machine keeps the promise too.
  static constexpr std::chrono::milliseconds kFlushEvery{500};

  /// Creates the file, under a number where one is there (core/sink_file.h), which the log says; named .zst
  /// it is compressed. header: of the game that it will watch. disk: a pool of one thread, so that lines keep
  /// their order; it outlives the recording.
  static core::Expected<std::unique_ptr<Recorder>> open(const std::filesystem::path& file,
                                                        replay::Header header, boost::asio::thread_pool& disk,
                                                        std::shared_ptr<spdlog::logger> log);

  /// The same into any sink; `name` says in the log what can't be written, and .zst at its end that it is
  /// packed.
  Recorder(std::unique_ptr<core::ByteSink> out, std::string name, replay::Header header,
           boost::asio::thread_pool& disk, std::shared_ptr<spdlog::logger> log);

  /// announce: told why, once, when the recording ends before its time.
  void attach(Announce announce) override { announce_ = std::move(announce); }
  void begin(const match::Match& game) override;
  void chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
            const std::string& text) override;
  /// The game is copied where a keyframe is due.
  void step(const match::StepRecord& record, std::span<const InputMargin> margins,
            const match::Match& game) override;
  /// The pause is told when it is over; a server that is killed within one leaves it untold.
  void fall_asleep(const match::Match& game) override;
  void wake(const match::Match& game) override;
  /// `done` is called on the disk's thread when everything is in the file.
  void finish(const std::string& reason, std::function<void()> done) override;

 private:
  using Job = std::function<void(std::string&)>;
  void enqueue(Job job);
  void await_flush();
  void write_out();
  void judge(const core::Expected<void>& outcome);
  void give_up(const std::string& why);

  std::string name_;
  boost::asio::thread_pool& disk_;
  std::shared_ptr<spdlog::logger> log_;
  replay::Header header_;
  Announce announce_;
  std::optional<replay::PauseLine> pause_;  ///< that is not over; the room's strand's
  std::atomic<std::size_t> queued_{0};
  std::atomic<bool> failed_{false};
  std::uint64_t keyframe_ticks_ = 0;
  // The disk thread's, after begin():
  std::unique_ptr<core::ByteSink> out_;
  replay::ReplayWriter writer_;
  boost::asio::steady_timer flush_timer_;
  bool finished_ = false;
  bool will_flush_ = false;                 ///< the timer runs
  std::string bytes_;                       ///< not yet in the file
  std::uint64_t left_out_at_ = UINT64_MAX;  ///< the last tick at which chat was left out
};

}  // namespace woodlouse::server
