#include "server/recorder.h"

#include <boost/asio/post.hpp>

#include <cerrno>
#include <cstring>
#include <utility>

namespace woodlouse::server {
namespace {

constexpr std::uint32_t kFlushEvery = 60;  // jobs; what a killed server may lose of its recording

}  // namespace

core::Expected<std::unique_ptr<Recorder>> Recorder::open(const std::filesystem::path& file,
                                                         boost::asio::thread_pool& disk,
                                                         std::shared_ptr<spdlog::logger> log) {
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (!out)
    return core::fail("cannot write the recording " + file.string(), std::strerror(errno),
                      "does its folder exist, and may you write there?");
  return std::unique_ptr<Recorder>(new Recorder(file, std::move(out), disk, std::move(log)));
}

Recorder::Recorder(std::filesystem::path file, std::ofstream out, boost::asio::thread_pool& disk,
                   std::shared_ptr<spdlog::logger> log)
    : file_(std::move(file)), disk_(disk), log_(std::move(log)), out_(std::move(out)) {}

void Recorder::begin(const replay::Header& header) {
  keyframe_ticks_ = replay::kKeyframeSeconds * header.tick_hz;
  writer_ = std::make_unique<replay::ReplayWriter>(keyframe_ticks_);
  enqueue([this, header](std::string& out) { writer_->append_header(out, header); });
}

void Recorder::player(match::PlayerId player, const std::string& name, protocol::Role role) {
  enqueue([this, player, name, role](std::string&) { writer_->note_player(player, name, role); });
}

void Recorder::chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
                    const std::string& text) {
  enqueue([this, tick, player, name, text](std::string& out) {
    writer_->append_chat(out, tick, player, name, text);
  });
}

void Recorder::step(const match::StepRecord& record, std::vector<InputMargin> margins,
                    std::span<const physics::Louse> lice) {
  std::vector<physics::Louse> keyframe;
  if ((record.tick + 1) % keyframe_ticks_ == 0) keyframe.assign(lice.begin(), lice.end());
  enqueue([this, record, margins = std::move(margins), keyframe = std::move(keyframe)](std::string& out) {
    for (const InputMargin& margin : margins)
      writer_->note_margin(margin.player, margin.seq, margin.microseconds);
    writer_->append_step(out, record, keyframe);
  });
}

void Recorder::finish(std::uint64_t tick, const std::string& reason, std::function<void()> done) {
  boost::asio::post(disk_, [this, tick, reason, done = std::move(done)] {
    if (!failed_) {
      text_.clear();
      writer_->append_end(text_, tick, reason);
      write(text_);
      errno = 0;
      out_.close();
      if (!failed_ && !out_) give_up(std::strerror(errno));
    }
    done();
  });
}

void Recorder::enqueue(Job job) {
  if (failed_) return;
  if (queued_.fetch_add(1) >= kMaxQueued) return give_up("the disk is too slow");
  boost::asio::post(disk_, [this, job = std::move(job)] {
    if (!failed_) {
      text_.clear();
      job(text_);
      write(text_);
    }
    queued_.fetch_sub(1);
  });
}

void Recorder::write(const std::string& text) {
  errno = 0;
  out_ << text;
  if (++unflushed_ >= kFlushEvery) {
    out_.flush();
    unflushed_ = 0;
  }
  if (!out_) give_up(std::strerror(errno));
}

void Recorder::give_up(const std::string& why) {
  if (failed_.exchange(true)) return;
  log_->error("RECORDING ENDED: cannot write {}: {}; the game goes on, what follows is not recorded",
              file_.string(), why);
}

}  // namespace woodlouse::server
