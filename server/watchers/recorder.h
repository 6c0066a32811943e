// Writes a recording while the game runs. Lines are made, packed and written on a thread of the recording's
// own; the tick hands over values and goes on. What happened is in the file at most a second later, also when
// nothing more happens. A disk that fails or falls kMaxQueued steps behind ends the recording with one loud
// log line and a word to the room, never the game; other rooms' recordings hear nothing of it.
#pragma once

#include <spdlog/logger.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "server/room/tick_watcher.h"
#include "server/timing/clock.h"
#include "server/watchers/job_thread.h"
#include "server/watchers/recording_files.h"
#include "server/watchers/recording_writer.h"
#include "shared/core/byte_sink.h"
#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

/// One game's recording, in one file or several. Everything but open() returns at once, whatever the disk
/// does; the destructor, too.
class Recorder final : public TickWatcher {
 public:
  static constexpr std::size_t kMaxQueued = 1200;  ///< jobs waiting for the disk: 20 s of steps at 60 Hz
  /// Half of what a killed server may lose, so that a busy machine keeps the promise too.
  static constexpr std::chrono::milliseconds kFlushEvery{500};

  /// Creates the first file, whose number, where it has one, the log tells. header: of the game that it will
  /// watch. every: how long a file is, to the nearest keyframe; none: as long as the game, or until it is
  /// asked for the next one. Throws std::system_error where the system gives no thread.
  static core::Expected<std::unique_ptr<Recorder>> open(std::shared_ptr<RecordingFiles> files,
                                                        const std::string& room, replay::Header header,
                                                        std::optional<Duration> every,
                                                        std::shared_ptr<spdlog::logger> log);

  /// Into any sink, and no other; `name` says in the log what can't be written, and .zst at its end that it
  /// is packed.
  Recorder(std::unique_ptr<core::ByteSink> out, std::string name, replay::Header header,
           std::shared_ptr<spdlog::logger> log);
  ~Recorder() override;

  /// announce: told why, once, when the recording ends before its time.
  void attach(Announce announce) override { writer_->attach(std::move(announce)); }
  void begin(const match::Match& game) override;
  void chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
            const std::string& text) override;
  /// The game is copied where a keyframe is due.
  void step(const LiveStep& step, const match::Match& game) override;
  /// The pause is told when it is over; a server that is killed within one leaves it untold.
  void fall_asleep(const match::Match& game) override;
  void wake(const match::Match& game) override;
  /// `done` is called on the recording's thread when everything is in the file; never, once the writer is
  /// left behind.
  void finish(const std::string& reason, std::function<void()> done) override;
  void add_figures(RoomFigures& figures) const override;

  [[nodiscard]] bool is_recording() const override { return !writer_->has_failed(); }

  /// What outlives it: for whoever waits for the end.
  [[nodiscard]] const std::shared_ptr<RecordingWriter>& writer() const { return writer_; }
  [[nodiscard]] const std::shared_ptr<JobThread>& thread() const { return thread_; }

 private:
  Recorder(std::shared_ptr<RecordingWriter> writer, const replay::Header& header,
           std::optional<Duration> every);
  void enqueue(JobThread::Job job);
  [[nodiscard]] bool is_next_file_due();

  const std::shared_ptr<RecordingWriter> writer_;
  const std::shared_ptr<JobThread> thread_;
  const std::uint32_t tick_hz_;
  const std::uint64_t keyframe_ticks_;
  const std::optional<Duration> every_;
  // The room's strand's:
  Time file_began_;
  std::optional<replay::PauseLine> pause_;  ///< that is not over
};

}  // namespace woodlouse::server
