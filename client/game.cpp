#include "client/game.h"

#include <unistd.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace woodlouse::client {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kHurriedGap{10};  // between frames that keys bring forward
constexpr std::chrono::milliseconds kServerCheck{500};

}  // namespace

Game::Game(boost::asio::io_context& context, Session& session, TerminalGuard& guard, int keys,
           TerminalScreen& screen, const GameSettings& settings, std::function<bool()> server_alive)
    : context_(context),
      session_(session),
      guard_(guard),
      screen_(screen),
      settings_(settings),
      server_alive_(std::move(server_alive)),
      keys_(
          context, keys, [this](const TerminalInput& input) { on_input(input); },
          [this] {
            finish({kExitIo, "woodlouse: the terminal is gone\n"});
          }),
      timer_(context),
      output_(context, dup(screen.fd())) {}

Outcome Game::run() {
  interface_.view = settings_.view.value_or(default_view(settings_.look, terminal_size(STDOUT_FILENO)));
  interface_.overlay = settings_.first;
  guard_.query_kitty();
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

void Game::finish(Outcome outcome) {
  if (!outcome_) outcome_ = std::move(outcome);
}

void Game::on_input(const TerminalInput& input) {
  if (const Key* key = std::get_if<Key>(&input)) return on_key(*key);
  if (const Paste* paste = std::get_if<Paste>(&input); paste != nullptr && interface_.chatting) {
    chat_.paste(paste->text);
    hurry();
  }
  if (std::holds_alternative<KittyFlags>(input)) guard_.push_kitty();
  if (const Focus* focus = std::get_if<Focus>(&input); focus != nullptr && *focus == Focus::kLost) {
    if (Pilot* pilot = session_.room().pilot()) pilot->steering().release_all();
  }
}

void Game::on_key(const Key& key) {
  if (interface_.chatting && !control_action(key)) {
    bindings_.observe(key);
    // A push begun before the chat was opened still ends with its key.
    if (key.action == KeyAction::kRelease) {
      if (const auto action = bindings_.on_key(key, interface_.overlay)) perform(*action);
    } else {
      close_chat(chat_.type(key));
    }
    return hurry();
  }
  if (const auto action = bindings_.on_key(key, interface_.overlay)) {
    perform(*action);
    hurry();
  }
}

void Game::close_chat(ChatEntry::Outcome outcome) {
  if (outcome == ChatEntry::Outcome::kTyping) return;
  if (outcome == ChatEntry::Outcome::kSend) session_.room().say(chat_.text());
  interface_.chatting = false;
  chat_.clear();
}

void Game::perform(Action action) {
  if (drive(action) || interface_.apply(action)) return;
  switch (action) {
    case Action::kRespawn:
      session_.room().respawn();
      break;
    case Action::kNextLouse:
      interface_.follow_id = next_louse(session_.room(), followed(session_.room(), interface_.follow_id));
      break;
    case Action::kConfirm:
      finish({});
      break;
    case Action::kQuitNow:
      finish({kExitInterrupted, ""});
      break;
    case Action::kSuspend:
      guard_.suspend();
      break;
    case Action::kRedraw:
      screen_.invalidate();
      break;
    default:
      break;
  }
}

bool Game::drive(Action action) {
  Pilot* const pilot = session_.room().pilot();
  const TimePoint now = steady_clock::now();
  switch (action) {
    case Action::kPushPulse:
      if (pilot != nullptr) pilot->steering().push(now);
      return true;
    case Action::kPushHold:
      if (pilot != nullptr) pilot->steering().hold_push();
      return true;
    case Action::kPushRelease:
      if (pilot != nullptr) pilot->steering().release_push();
      return true;
    case Action::kBrakePulse:
      if (pilot != nullptr) pilot->steering().brake(now);
      return true;
    case Action::kBrakeHold:
      if (pilot != nullptr) pilot->steering().hold_brake();
      return true;
    case Action::kBrakeRelease:
      if (pilot != nullptr) pilot->steering().release_brake();
      return true;
    case Action::kTurnLeft:
      if (pilot != nullptr) pilot->steering().turn(Turn::kLeft);
      return true;
    case Action::kTurnRight:
      if (pilot != nullptr) pilot->steering().turn(Turn::kRight);
      return true;
    case Action::kCruise:
      if (pilot != nullptr) pilot->steering().toggle_cruise();
      return true;
    default:
      return false;
  }
}

void Game::schedule(TimePoint at) {
  timer_.expires_at(at);
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) frame();
  });
}

void Game::hurry() {
  const TimePoint soonest = std::max(steady_clock::now(), last_frame_ + kHurriedGap);
  if (soonest < next_frame_) schedule(soonest);
}

void Game::frame() {
  if (outcome_) return;
  const TimePoint now = steady_clock::now();
  last_frame_ = now;
  session_.update(now);
  if (server_is_lost(now)) return;
  show(now);
  if (outcome_) return;
  const std::chrono::nanoseconds period = std::chrono::nanoseconds(std::chrono::seconds(1)) / settings_.fps;
  if (now >= next_frame_) {
    next_frame_ += period;
    if (next_frame_ <= now) next_frame_ = now + period;  // frames that were missed are missed
  }
  schedule(next_frame_);
}

bool Game::server_is_lost(TimePoint now) {
  if (session_.failure()) {
    const core::Error& error = *session_.failure();
    finish(
        {kExitUnreachable, "woodlouse: " + error.where + ": " + error.what + "\n      " + error.hint + "\n"});
  } else if (server_alive_ && now - server_seen_ >= kServerCheck) {
    server_seen_ = now;
    if (!server_alive_()) finish({kExitUnreachable, "woodlouse: the server started here has ended\n"});
  }
  return outcome_.has_value();
}

void Game::show(TimePoint now) {
  const Size size = terminal_size(STDOUT_FILENO);
  if (cells_.size() != size) cells_.resize(size);
  if (guard_.take_resumed()) screen_.invalidate();
  const FrameFacts facts{settings_.look, fps_, bindings_.release_seen(), now};
  composer_.draw(build_scene(session_, interface_, chat_, facts), cells_);
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

void Game::flush_when_taken() {
  if (flushing_ || screen_.flush()) return;
  flushing_ = true;
  output_.async_wait(boost::asio::posix::stream_descriptor::wait_write,
                     [this](boost::system::error_code error) {
                       flushing_ = false;
                       if (!error && !outcome_) flush_when_taken();
                     });
}

}  // namespace woodlouse::client
