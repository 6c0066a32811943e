#include "server/watchers/recording_writer.h"

#include <spdlog/fmt/fmt.h>

#include <cassert>
#include <filesystem>
#include <system_error>
#include <utility>

#include "server/logging/events.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kWriteAt = 256u << 10;  // bytes that are not kept back for the next flush

}  // namespace

RecordingWriter::RecordingWriter(std::unique_ptr<core::ByteSink> out, std::string name, std::string room,
                                 replay::Header header, std::shared_ptr<RecordingFiles> files,
                                 std::shared_ptr<spdlog::logger> log)
    : room_(std::move(room)),
      files_(std::move(files)),
      name_(std::move(name)),
      log_(std::move(log)),
      header_(std::move(header)),
      out_(std::move(out)),
      lines_(replay::encoding_of(name_)) {
  assert(out_ != nullptr);
}

// ---- any thread ----------------------------------------------------------------------------------------

void RecordingWriter::attach(TickWatcher::Announce announce) {
  const std::lock_guard lock(outside_);
  announce_ = std::move(announce);
  has_begun_ = true;
}

void RecordingWriter::when_finished(std::function<void()> done) {
  const std::lock_guard lock(outside_);
  done_ = std::move(done);
}

void RecordingWriter::give_up(const std::string& why) {
  const std::lock_guard lock(outside_);
  if (has_finished_ || failed_.exchange(true)) return;
  why_lost_ = why;
  if (log_)
    log_event(
        *log_, LogEvent::kRecordingEnded,
        fmt::format("RECORDING ENDED: cannot write {}: {}; the game goes on, what follows is not recorded",
                    name_, why));
  if (announce_)
    announce_({std::string(protocol::code::kRecordingEnded), "the game is no longer recorded: " + why});
}

void RecordingWriter::leave_behind(const std::string& why) {
  std::function<void()> done;  // may be the last to hold the room, which is not to go under the lock
  const std::lock_guard lock(outside_);
  if (has_begun_ && !has_finished_ && !failed_.exchange(true)) {
    why_lost_ = why;
    if (log_)
      log_event(*log_, LogEvent::kRecordingUnfinished,
                fmt::format("RECORDING UNFINISHED: {}: {}", name_, why));
  }
  log_.reset();
  announce_ = nullptr;
  done = std::exchange(done_, nullptr);
}

void RecordingWriter::add_figures(RecordingFigures& all) const {
  all.written_bytes += written_bytes_;
  all.lost_bytes += lost_bytes_;
  all.lost_ticks += lost_ticks_;
  all.failed |= failed_;
}

std::string RecordingWriter::lost() const {
  const std::lock_guard lock(outside_);
  return why_lost_.empty() ? std::string() : name_ + ": " + why_lost_;
}

void RecordingWriter::say(LogEvent event, const std::string& text) {
  const std::lock_guard lock(outside_);
  if (log_) log_event(*log_, event, text);
}

/// Called and let go of under the lock: whoever has left this behind may end what is told.
void RecordingWriter::tell_finished() {
  const std::lock_guard lock(outside_);
  if (done_) std::exchange(done_, nullptr)();
}

// ---- the thread ----------------------------------------------------------------------------------------

/// What can't be written any more is closed here: that, too, may wait.
bool RecordingWriter::is_writing() {
  if (failed_ && out_ != nullptr) {
    lost_bytes_ += std::exchange(bytes_, {}).size();
    out_.reset();
    if (files_) files_->closed(name_);
  }
  return out_ != nullptr;
}

void RecordingWriter::begin(const match::MatchState& first) {
  if (!is_writing()) return;
  lines_.append_header(bytes_, header_);
  lines_.append_keyframe(bytes_, first);
}

void RecordingWriter::chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
                           const std::string& text) {
  if (!is_writing()) return;
  const bool fits = lines_.append_chat(bytes_, tick, player, name, text);
  if (!fits && std::exchange(left_out_at_, tick) != tick)
    say(LogEvent::kChatLeftOut,
        fmt::format("{}: more was said at tick {} than a recording holds, the rest of it is left out", name_,
                    tick));
  write_when_much();
}

void RecordingWriter::step(const RecordedStep& step) {
  if (!is_writing()) return lose_tick();
  const bool has_line = !lines_.is_quiet(step.record());
  lines_.append_step(bytes_, step.record(), has_line ? std::string_view(step.line()) : std::string_view());
  write_when_much();
}

void RecordingWriter::keyframe(const match::MatchState& state, bool next_file) {
  if (!is_writing()) return;
  lines_.append_keyframe(bytes_, state);
  if (!next_file) return write_when_much();
  write_out();
  if (is_writing()) begin_next_file(state);
}

void RecordingWriter::pause(const replay::PauseLine& pause) {
  if (is_writing()) lines_.append_pause(bytes_, pause);
}

void RecordingWriter::finish(const std::string& reason) {
  if (is_writing()) write_out();
  if (is_writing()) close(reason);
  {
    const std::lock_guard lock(outside_);
    has_finished_ = !failed_;
  }
  tell_finished();
}

void RecordingWriter::flush() {
  if (!is_writing()) return;
  lines_.flush(bytes_);
  write_out();
}

void RecordingWriter::write_when_much() {
  if (bytes_.size() >= kWriteAt) write_out();
}

void RecordingWriter::write_out() {
  if (files_ && !bytes_.empty()) {
    const RecordingFiles::Removed removed = files_->make_room(name_, bytes_.size());
    if (removed.files > 0)
      say(LogEvent::kRecordingsRemoved,
          fmt::format("removed {} of the oldest recordings, {} bytes, up to {}: all are to have {} bytes; "
                      "{} removed so far",
                      removed.files, removed.bytes, removed.last, *files_->keep(), files_->removed()));
    if (!removed.fits) {
      const std::string why = "all that --record-keep grants is used up, nothing is left to remove";
      close(why);
      return give_up(why);
    }
  }
  put();
}

/// Not by way of write_out(): the last lines are written past any bound, so that the file has its end.
void RecordingWriter::close(const std::string& reason) {
  lines_.append_end(bytes_, reason);
  put();
  if (!is_writing()) return;
  judge(out_->close());
  out_.reset();
  if (files_) files_->closed(name_);
}

/// Where none can be made, this one goes on: nothing of the game is lost.
void RecordingWriter::begin_next_file(const match::MatchState& at) {
  std::error_code error;
  if (!files_ || !std::filesystem::is_regular_file(name_, error))
    return say(LogEvent::kRecordingNoFile,
               fmt::format("{}: is no file that another could follow: it goes on", name_));
  auto next = files_->create(room_);
  if (!next)
    return say(LogEvent::kRecordingNotFollowed,
               fmt::format("no recording can follow {}, which goes on: {}", name_, next.error().text()));
  const std::string name = next->path.string();
  close("continued in " + name);
  if (failed_) {
    files_->closed(name);
    std::filesystem::remove(name, error);  // nothing is in it
    return;
  }
  say(LogEvent::kRecordingContinued,
      fmt::format("{}: continued in {} from tick {} on", name_, name, at.tick));
  header_.parent = replay::Parent{name_, at.tick, at.hash};
  {
    const std::lock_guard lock(outside_);
    name_ = name;
  }
  out_ = std::move(next->sink);
  lines_ = replay::ReplayWriter(replay::encoding_of(name_));
  begin(at);
}

void RecordingWriter::put() {
  const auto outcome = out_->write(bytes_);
  (outcome ? written_bytes_ : lost_bytes_) += bytes_.size();
  bytes_.clear();
  judge(outcome);
}

void RecordingWriter::judge(const core::Expected<void>& outcome) {
  if (!outcome) give_up(outcome.error().what);
}

}  // namespace woodlouse::server
