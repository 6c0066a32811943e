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
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/replay/writer.h"

namespace woodlouse::server {

/// How long before its step an input came; negative: after the step it asked for.
struct InputMargin {
  match::PlayerId player = 0;
  std::uint32_t seq = 0;
  std::int64_t microseconds = 0;
};

/// One recording. The room's strand calls it; it outlives the disk's thread. Everything but open() returns at
/// once.
class Recorder {
 public:
  static constexpr std::size_t kMaxQueued = 1200;  ///< jobs waiting for the disk: 20 s of steps at 60 Hz
  /// Half of what a killed server may lose, so that a busy machine keeps the promise too.
  static constexpr std::chrono::milliseconds kFlushEvery{500};

  /// Creates the file, over one that is there; named .zst it is compressed. disk: a pool of one thread, so
  /// that lines keep their order.
  static core::Expected<std::unique_ptr<Recorder>> open(const std::filesystem::path& file,
                                                        boost::asio::thread_pool& disk,
                                                        std::shared_ptr<spdlog::logger> log);

  /// Who is told why, once, on some thread, when the recording ends before its time. Before begin().
  void on_failure(std::function<void(const std::string& why)> failed) { on_failure_ = std::move(failed); }

  /// First of all, once. `first`: the match as it stands; nothing is queued in it.
  void begin(const replay::Header& header, match::MatchState first);
  /// Before the step that applies the join; of those in the first state: before begin().
  void player(match::PlayerId player, const std::string& name, protocol::Role role);
  void chat(std::uint64_t tick, match::PlayerId player, const std::string& name, const std::string& text);
  /// After the step. `match`: as the step left it, nothing queued since; copied where a keyframe is due.
  void step(const match::StepRecord& record, std::vector<InputMargin> margins, const match::Match& match);
  /// Last of all, once; `done` is called on the disk's thread when everything is in the file.
  void finish(const std::string& reason, std::function<void()> done);

 private:
  Recorder(std::filesystem::path file, std::ofstream out, boost::asio::thread_pool& disk,
           std::shared_ptr<spdlog::logger> log);

  using Job = std::function<void(std::string&)>;
  void enqueue(Job job);
  void await_flush();
  void write_out();
  void give_up(const std::string& why);

  std::filesystem::path file_;
  boost::asio::thread_pool& disk_;
  std::shared_ptr<spdlog::logger> log_;
  std::function<void(const std::string&)> on_failure_;
  std::atomic<std::size_t> queued_{0};
  std::atomic<bool> failed_{false};
  std::uint64_t keyframe_ticks_ = 0;
  // The disk thread's, after begin():
  std::ofstream out_;
  replay::ReplayWriter writer_;
  boost::asio::steady_timer flush_timer_;
  bool will_flush_ = false;  ///< the timer runs
  std::string bytes_;        ///< not yet in the file
};

}  // namespace woodlouse::server
