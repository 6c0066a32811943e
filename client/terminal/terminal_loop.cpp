#include "client/terminal/terminal_loop.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

namespace woodlouse::client {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kHurriedGap{10};  // between frames that keys bring forward

}  // namespace

TerminalLoop::TerminalLoop(boost::asio::io_context& context, TerminalGuard& guard, KeySource keys,
                           TerminalScreen& screen, int fps, Performance& performance)
    : context_(context),
      guard_(guard),
      screen_(screen),
      performance_(performance),
      frames_a_second_(fps),
      keys_(
          context, std::move(keys), [this](const TerminalInput& input) { on_input(input); },
          [this] {
            finish({kExitIo, "woodlouse: the terminal is gone\n"});
          }),
      timer_(context),
      output_(context, dup(screen.fd())) {}

Outcome TerminalLoop::run() {
  keys_.start();
  second_began_ = next_frame_ = steady_clock::now();
  frame();
  context_.restart();
  while (!outcome_) context_.run_one();
  keys_.stop();
  timer_.cancel();
  output_.cancel();
  context_.poll();  // what was already on its way here, while there still is a here
  return *outcome_;
}

void TerminalLoop::finish(Outcome outcome) {
  if (!outcome_) outcome_ = std::move(outcome);
}

void TerminalLoop::on_input(const TerminalInput& input) {
  // Answers that came too late for the look.
  if (std::holds_alternative<KittyFlags>(input)) guard_.push_kitty();
  if (std::holds_alternative<DeviceAttributes>(input)) guard_.note_answer();
  performance_.on_input(input);
}

void TerminalLoop::schedule(core::Time at) {
  timer_.expires_at(at);
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) frame();
  });
}

void TerminalLoop::hurry() {
  const core::Time soonest = std::max(steady_clock::now(), last_frame_ + kHurriedGap);
  if (soonest < next_frame_) schedule(soonest);
}

void TerminalLoop::frame() {
  if (outcome_) return;
  const core::Time now = steady_clock::now();
  last_frame_ = now;
  const Scene scene = performance_.scene(now, fps_);
  if (!outcome_) show(scene, now);
  if (outcome_) return;
  const std::chrono::nanoseconds period =
      std::chrono::nanoseconds(std::chrono::seconds(1)) / frames_a_second_;
  if (now >= next_frame_) {
    next_frame_ += period;
    if (next_frame_ <= now) next_frame_ = now + period;  // frames that were missed are missed
  }
  schedule(next_frame_);
}

void TerminalLoop::show(const Scene& scene, core::Time now) {
  const Size size = terminal_size(STDOUT_FILENO);
  if (cells_.size() != size) cells_.resize(size);
  if (guard_.take_resumed()) screen_.invalidate();
  composer_.draw(scene, cells_);
  const FrameResult result = screen_.show(cells_);
  if (result == FrameResult::kShown) flush_when_taken();
  if (result == FrameResult::kFailed) finish({kExitIo, "woodlouse: the terminal takes no more output\n"});
  frames_ += result == FrameResult::kDropped ? 0 : 1;
  const double seconds = std::chrono::duration<double>(now - second_began_).count();
  if (seconds < 1.0) return;
  fps_ = frames_ / seconds;
  frames_ = 0;
  second_began_ = now;
}

void TerminalLoop::flush_when_taken() {
  if (flushing_ || screen_.flush()) return;
  flushing_ = true;
  output_.async_wait(boost::asio::posix::stream_descriptor::wait_write,
                     [this](boost::system::error_code error) {
                       flushing_ = false;
                       if (!error && !outcome_) flush_when_taken();
                     });
}

}  // namespace woodlouse::client
