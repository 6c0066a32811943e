#include "server/watchers/recorder.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <cassert>
#include <chrono>
#include <utility>

#include "shared/core/sink_file.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

/// UTC, as people's clocks have it; no hash knows of it.
std::uint64_t seconds_since_1970() {
  using namespace std::chrono;
  const auto since = duration_cast<seconds>(system_clock::now().time_since_epoch()).count();
  return since > 0 ? static_cast<std::uint64_t>(since) : 0;
}

constexpr std::size_t kWriteAt = 256u << 10;  // bytes that are not kept back for the next flush

}  // namespace

core::Expected<std::unique_ptr<Recorder>> Recorder::open(const std::filesystem::path& file,
                                                         replay::Header header,
                                                         boost::asio::thread_pool& disk,
                                                         std::shared_ptr<spdlog::logger> log) {
  auto out = core::create_file(file);
  if (!out)
    return core::fail(
        "cannot write the recording " + file.string(), out.error().what,
        out.error().hint.empty() ? "does its folder exist, and may you write there?" : out.error().hint);
  if (out->path != file)
    log->warn(fmt::format("{} is there already: recording to {}", file.string(), out->path.string()));
  return std::make_unique<Recorder>(std::move(out->sink), out->path.string(), std::move(header), disk,
                                    std::move(log));
}

Recorder::Recorder(std::unique_ptr<core::ByteSink> out, std::string name, replay::Header header,
                   boost::asio::thread_pool& disk, std::shared_ptr<spdlog::logger> log)
    : name_(std::move(name)),
      disk_(disk),
      log_(std::move(log)),
      header_(std::move(header)),
      keyframe_ticks_(replay::keyframe_ticks(header_.tick_hz)),
      out_(std::move(out)),
      writer_(replay::encoding_of(name_)),
      flush_timer_(disk.get_executor()) {
  assert(out_ != nullptr);
}

void Recorder::begin(const match::Match& game) {
  assert(game.settings().tick_hz == header_.tick_hz);
  enqueue([this, first = game.state()](std::string& out) {
    writer_.append_header(out, header_);
    writer_.append_keyframe(out, first);
  });
}

void Recorder::chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
                    const std::string& text) {
  enqueue([this, tick, player, name, text](std::string& out) {
    const bool fits = writer_.append_chat(out, tick, player, name, text);
    if (!fits && std::exchange(left_out_at_, tick) != tick)
      log_->warn(fmt::format(
          "{}: more was said at tick {} than a recording holds, the rest of it is left out", name_, tick));
  });
}

void Recorder::step(const match::StepRecord& record, std::span<const InputMargin> margins,
                    const match::Match& game) {
  if (failed_) return;
  std::shared_ptr<const match::MatchState> keyframe;
  if (game.tick() % keyframe_ticks_ == 0) keyframe = std::make_shared<const match::MatchState>(game.state());
  enqueue([this, record, margins = std::vector(margins.begin(), margins.end()),
           keyframe = std::move(keyframe)](std::string& out) {
    for (const InputMargin& margin : margins)
      writer_.note_margin(margin.player, margin.seq, margin.microseconds);
    writer_.append_step(out, record);
    if (keyframe) writer_.append_keyframe(out, *keyframe);
  });
}

void Recorder::fall_asleep(const match::Match& game) { pause_ = {game.tick(), seconds_since_1970(), 0}; }

void Recorder::wake(const match::Match&) {
  assert(pause_);
  pause_->until = seconds_since_1970();
  enqueue([this, pause = *std::exchange(pause_, std::nullopt)](std::string& out) {
    writer_.append_pause(out, pause);
  });
}

void Recorder::finish(const std::string& reason, std::function<void()> done) {
  if (pause_) pause_->until = seconds_since_1970();
  boost::asio::post(disk_,
                    [this, reason, pause = std::exchange(pause_, std::nullopt), done = std::move(done)] {
                      flush_timer_.cancel();
                      finished_ = true;
                      if (!failed_) {
                        if (pause) writer_.append_pause(bytes_, *pause);
                        writer_.append_end(bytes_, reason);
                        write_out();
                        if (!failed_) judge(out_->close());
                      }
                      // Behind the cancelled timer's handler: whoever is told may let go of the recording.
                      boost::asio::post(disk_, done);
                    });
}

void Recorder::enqueue(Job job) {
  if (failed_) return;
  if (queued_.fetch_add(1) >= kMaxQueued) return give_up("the disk is too slow");
  boost::asio::post(disk_, [this, job = std::move(job)] {
    if (!failed_) {
      job(bytes_);
      if (bytes_.size() >= kWriteAt) write_out();
      if (!std::exchange(will_flush_, true)) await_flush();
    }
    queued_.fetch_sub(1);
  });
}

void Recorder::await_flush() {
  flush_timer_.expires_after(kFlushEvery);
  flush_timer_.async_wait([this](const boost::system::error_code& error) {
    will_flush_ = false;
    if (error || failed_ || finished_) return;
    writer_.flush(bytes_);
    write_out();
  });
}

void Recorder::write_out() {
  judge(out_->write(bytes_));
  bytes_.clear();
}

void Recorder::judge(const core::Expected<void>& outcome) {
  if (!outcome) give_up(outcome.error().what);
}

void Recorder::give_up(const std::string& why) {
  if (failed_.exchange(true)) return;
  log_->error(fmt::format(
      "RECORDING ENDED: cannot write {}: {}; the game goes on, what follows is not recorded", name_, why));
  if (announce_)
    announce_({std::string(protocol::code::kRecordingEnded), "the game is no longer recorded: " + why});
}

}  // namespace woodlouse::server
