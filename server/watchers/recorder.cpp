#include "server/watchers/recorder.h"

#include <spdlog/fmt/fmt.h>

#include <cassert>
#include <utility>
#include <vector>

#include "server/logging/events.h"
#include "shared/replay/writer.h"

namespace woodlouse::server {
namespace {

/// UTC, as people's clocks have it; no hash knows of it.
std::uint64_t seconds_since_1970() {
  using namespace std::chrono;
  const auto since = duration_cast<seconds>(system_clock::now().time_since_epoch()).count();
  return since > 0 ? static_cast<std::uint64_t>(since) : 0;
}

}  // namespace

core::Expected<std::unique_ptr<Recorder>> Recorder::open(std::shared_ptr<RecordingFiles> files,
                                                         const std::string& room, replay::Header header,
                                                         std::optional<Duration> every,
                                                         std::shared_ptr<spdlog::logger> log) {
  auto out = files->create(room);
  if (!out)
    return core::fail(
        "cannot write the recording " + out.error().where, out.error().what,
        out.error().hint.empty() ? "does its folder exist, and may you write there?" : out.error().hint);
  if (out->is_numbered)
    log_event(
        *log, LogEvent::kRecordingRenamed,
        fmt::format("{} is there already: recording to {}", files->file(room).string(), out->path.string()));
  const replay::Header first = header;
  return std::unique_ptr<Recorder>(
      new Recorder(std::make_shared<RecordingWriter>(std::move(out->sink), out->path.string(), room,
                                                     std::move(header), std::move(files), std::move(log)),
                   first, every));
}

Recorder::Recorder(std::unique_ptr<core::ByteSink> out, std::string name, replay::Header header,
                   std::shared_ptr<spdlog::logger> log)
    : Recorder(std::make_shared<RecordingWriter>(std::move(out), std::move(name), "", header, nullptr,
                                                 std::move(log)),
               header, std::nullopt) {}

Recorder::Recorder(std::shared_ptr<RecordingWriter> writer, const replay::Header& header,
                   std::optional<Duration> every)
    : writer_(std::move(writer)),
      thread_(std::make_shared<JobThread>(kMaxQueued, kFlushEvery, [writer = writer_] { writer->flush(); })),
      tick_hz_(header.tick_hz),
      keyframe_ticks_(replay::keyframe_ticks(header.tick_hz)),
      every_(every) {}

Recorder::~Recorder() { thread_->close(); }

void Recorder::begin(const match::Match& game) {
  assert(game.settings().tick_hz == tick_hz_);
  file_began_ = Clock::now();
  enqueue([writer = writer_, first = game.state()] { writer->begin(first); });
}

void Recorder::chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
                    const std::string& text) {
  enqueue([writer = writer_, tick, player, name, text] { writer->chat(tick, player, name, text); });
}

void Recorder::step(const LiveStep& step, const match::Match& game) {
  if (writer_->has_failed()) return writer_->lose_tick();
  std::shared_ptr<const match::MatchState> keyframe;
  if (game.tick() % keyframe_ticks_ == 0) keyframe = std::make_shared<const match::MatchState>(game.state());
  const bool next_file = keyframe != nullptr && is_next_file_due();
  enqueue([writer = writer_, step = step.shared(), keyframe = std::move(keyframe), next_file] {
    writer->step(*step);
    if (keyframe) writer->keyframe(*keyframe, next_file);
  });
}

/// The nearest keyframe: a tick's delay must not make a file of 10 s one of 15 s.
bool Recorder::is_next_file_due() {
  constexpr Duration kHalf = std::chrono::seconds(replay::kKeyframeSeconds) / 2;
  const Time now = Clock::now();
  const bool is_asked = writer_->take_request();
  if (!is_asked && (!every_ || now - file_began_ + kHalf < *every_)) return false;
  file_began_ = now;
  return true;
}

void Recorder::fall_asleep(const match::Match& game) { pause_ = {game.tick(), seconds_since_1970(), 0}; }

void Recorder::wake(const match::Match&) {
  assert(pause_);
  pause_->until = seconds_since_1970();
  enqueue([writer = writer_, pause = *std::exchange(pause_, std::nullopt)] { writer->pause(pause); });
}

void Recorder::finish(const std::string& reason, std::function<void()> done) {
  if (pause_) pause_->until = seconds_since_1970();
  // Not with the job: a thread that stands still would keep what `done` holds.
  writer_->when_finished(std::move(done));
  thread_->post_last([writer = writer_, reason, pause = std::exchange(pause_, std::nullopt)] {
    if (pause) writer->pause(*pause);
    writer->finish(reason);
  });
}

void Recorder::add_figures(RoomFigures& figures) const {
  RecordingFigures& all = figures.recording ? *figures.recording : figures.recording.emplace();
  all.queued += thread_->waiting();
  writer_->add_figures(all);
}

void Recorder::enqueue(JobThread::Job job) {
  if (!writer_->has_failed() && !thread_->post(std::move(job))) writer_->give_up("the disk is too slow");
}

}  // namespace woodlouse::server
