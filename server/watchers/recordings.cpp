#include "server/watchers/recordings.h"

#include <algorithm>
#include <utility>

namespace woodlouse::server {

Recordings::Recordings(const RecordSettings& settings, std::shared_ptr<spdlog::logger> log)
    : every_(settings.every),
      files_(std::make_shared<RecordingFiles>(settings.pattern, settings.keep_bytes)),
      log_(std::move(log)) {}

Recordings::~Recordings() { end(Clock::now()); }

core::Expected<std::unique_ptr<Recorder>> Recordings::open(const std::string& room, replay::Header header) {
  auto recorder = Recorder::open(files_, room, std::move(header), every_, log_);
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [now = Clock::now()](const Entry& entry) {
    return entry.thread->wait_until(now) && entry.writer->lost().empty();
  });
  if (recorder)
    entries_.push_back({(*recorder)->writer(), (*recorder)->thread()});
  else
    ++not_opened_;
  return recorder;
}

std::size_t Recordings::ask_for_next_files() {
  const std::lock_guard lock(mutex_);
  std::size_t asked = 0;
  for (const Entry& entry : entries_) {
    if (entry.writer->has_failed()) continue;
    entry.writer->ask_for_next_file();
    ++asked;
  }
  return asked;
}

void Recordings::end(Time latest) {
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : entries_) entry.thread->close();
  for (const Entry& entry : entries_) {
    const bool has_ended = entry.thread->wait_until(latest);
    entry.writer->leave_behind(has_ended ? "its room did not stop, it has no end"
                                         : "the disk takes nothing: what was left is not in it");
  }
}

std::vector<std::string> Recordings::lost() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> result;
  for (const Entry& entry : entries_)
    if (std::string one = entry.writer->lost(); !one.empty()) result.push_back(std::move(one));
  return result;
}

}  // namespace woodlouse::server
