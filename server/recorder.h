// Writes a recording while the game runs. Lines are made and written on the disk's own thread; the tick hands
// over values and goes on. A disk that fails or falls kMaxQueued steps behind ends the recording with one
// loud log line, never the game.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/thread_pool.hpp>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/replay/replay_file.h"

namespace woodlouse::server {

/// How long before its step an input came.
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

  /// Creates the file, over one that is there. disk: a pool of one thread, so that lines keep their order.
  static core::Expected<std::unique_ptr<Recorder>> open(const std::filesystem::path& file,
                                                        boost::asio::thread_pool& disk,
                                                        std::shared_ptr<spdlog::logger> log);

  /// First of all, once.
  void begin(const replay::Header& header);
  /// Before the step that applies the join.
  void player(match::PlayerId player, const std::string& name, protocol::Role role);
  void chat(std::uint64_t tick, match::PlayerId player, const std::string& name, const std::string& text);
  /// After the step. `lice`: the world after it; copied where a keyframe is due.
  void step(const match::StepRecord& record, std::vector<InputMargin> margins,
            std::span<const physics::Louse> lice);
  /// Last of all, once; `done` is called on the disk's thread when everything is in the file.
  void finish(std::uint64_t tick, const std::string& reason, std::function<void()> done);

 private:
  Recorder(std::filesystem::path file, std::ofstream out, boost::asio::thread_pool& disk,
           std::shared_ptr<spdlog::logger> log);

  using Job = std::function<void(std::string&)>;
  void enqueue(Job job);
  void write(const std::string& text);
  void give_up(const std::string& why);

  std::filesystem::path file_;
  boost::asio::thread_pool& disk_;
  std::shared_ptr<spdlog::logger> log_;
  std::atomic<std::size_t> queued_{0};
  std::atomic<bool> failed_{false};
  std::uint32_t keyframe_ticks_ = 0;
  // The disk thread's, after begin():
  std::ofstream out_;
  std::unique_ptr<replay::ReplayWriter> writer_;
  std::uint32_t unflushed_ = 0;  ///< jobs since the last flush
  std::string text_;
};

}  // namespace woodlouse::server
