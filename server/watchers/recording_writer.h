// A game's recording on its own thread: makes lines, packs them, writes them, ends a file and begins the
// next. It outlives its recorder where it stands in a write().
#pragma once

#include <spdlog/logger.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/logging/events.h"
#include "server/room/tick_watcher.h"
#include "server/watchers/recording_files.h"
#include "shared/core/byte_sink.h"
#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/replay/format.h"
#include "shared/replay/writer.h"

namespace woodlouse::server {

class RecordingWriter {
 public:
  /// out: named `name`; of `files`, which has made it, or of a test, which has none: then no file follows.
  /// header: of the first file.
  RecordingWriter(std::unique_ptr<core::ByteSink> out, std::string name, std::string room,
                  replay::Header header, std::shared_ptr<RecordingFiles> files,
                  std::shared_ptr<spdlog::logger> log);

  // ---- any thread; none waits for the disk -------------------------------------------------------------

  /// What may be told from now on, and what is called once all is written.
  void attach(TickWatcher::Announce announce);
  void when_finished(std::function<void()> done);
  /// The game is no longer recorded: told once, in the log and to the room. Nothing, where it has finished.
  void give_up(const std::string& why);
  [[nodiscard]] bool has_failed() const { return failed_; }
  /// A tick has passed after it failed.
  void lose_tick() { ++lost_ticks_; }
  /// All but what waits.
  void add_figures(RecordingFigures& all) const;
  /// A file is to follow at the next keyframe.
  void ask_for_next_file() { is_asked_ = true; }
  [[nodiscard]] bool take_request() { return is_asked_.exchange(false); }
  /// For whoever waits no longer: what has no end yet counts as given up for this reason, and neither log nor
  /// room is touched again, whatever the thread still does.
  void leave_behind(const std::string& why);
  /// "FILE: why", of one that ended before its time; else empty.
  [[nodiscard]] std::string lost() const;

  // ---- its thread --------------------------------------------------------------------------------------

  void begin(const match::MatchState& first);
  void chat(std::uint64_t tick, match::PlayerId player, const std::string& name, const std::string& text);
  void step(const RecordedStep& step);
  /// next_file: what follows, this keyframe first, is another file's.
  void keyframe(const match::MatchState& state, bool next_file);
  void pause(const replay::PauseLine& pause);
  void finish(const std::string& reason);
  /// What was told so far is in the file.
  void flush();

 private:
  [[nodiscard]] bool is_writing();
  void write_when_much();
  void write_out();
  void close(const std::string& reason);
  void begin_next_file(const match::MatchState& at);
  void put();
  void judge(const core::Expected<void>& outcome);
  void say(LogEvent event, const std::string& text);
  void tell_finished();

  const std::string room_;
  const std::shared_ptr<RecordingFiles> files_;
  std::atomic<bool> failed_{false};
  std::atomic<bool> is_asked_{false};
  std::atomic<std::uint64_t> written_bytes_{0};
  std::atomic<std::uint64_t> lost_bytes_{0};
  std::atomic<std::uint64_t> lost_ticks_{0};

  /// Held while somebody is told, who never waits, and to end that.
  mutable std::mutex outside_;
  std::string name_;  ///< changed by the thread alone, which so reads it without
  std::shared_ptr<spdlog::logger> log_;
  TickWatcher::Announce announce_;
  std::function<void()> done_;
  std::string why_lost_;
  bool has_begun_ = false;
  bool has_finished_ = false;

  // The thread's:
  replay::Header header_;
  std::unique_ptr<core::ByteSink> out_;  ///< null: closed
  replay::ReplayWriter lines_;
  std::string bytes_;                       ///< not yet in the file
  std::uint64_t left_out_at_ = UINT64_MAX;  ///< the last tick at which chat was left out
};

}  // namespace woodlouse::server
