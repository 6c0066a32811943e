#include "client/play/game.h"

#include <unistd.h>

#include <chrono>
#include <utility>
#include <variant>

#include "client/drawing/layout.h"
#include "client/play/modes/way_words.h"
#include "client/play/outlook.h"
#include "client/play/own_error.h"
#include "client/play/spoken_words.h"

namespace woodlouse::client {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kServerCheck{500};
constexpr std::chrono::seconds kStillReading{15};  // since the game has begun by itself

/// Right and up in the picture, to what the rules want of you; up, where they want nothing.
core::Vec2 way_to_goal(const Scene& scene) {
  for (const LouseMark& louse : scene.lice)
    if (louse.is_you && scene.course.target)
      return in_picture(*scene.course.target - louse.position, scene.course.up);
  return {0.0, 1.0};
}

}  // namespace

Game::Game(boost::asio::io_context& context, Session& session, TerminalGuard& guard, KeySource keys,
           TerminalScreen& screen, const GameSettings& settings, std::function<bool()> server_alive)
    : session_(session),
      guard_(guard),
      screen_(screen),
      settings_(settings),
      server_alive_(std::move(server_alive)),
      bindings_(settings.keys),
      teacher_(settings.data),
      loop_(context, guard, std::move(keys), screen, settings.fps, *this) {}

Outcome Game::run() {
  interface_.view = settings_.view.value_or(View::kMap);
  interface_.has_chosen = settings_.view.has_value();
  interface_.has_oblique = paints_pixels(settings_.look);
  interface_.overlay = settings_.first;
  interface_.steer = settings_.steer;
  begun_ = steady_clock::now();
  return loop_.run();
}

void Game::on_input(const TerminalInput& input) {
  if (const Key* key = std::get_if<Key>(&input)) return on_key(*key);
  if (const Paste* paste = std::get_if<Paste>(&input); paste != nullptr && interface_.chatting) {
    chat_.paste(paste->text);
    loop_.hurry();
  }
  if (const Focus* focus = std::get_if<Focus>(&input); focus != nullptr && *focus == Focus::kLost) {
    if (Pilot* pilot = session_.room().pilot()) pilot->steering().release_all();
  }
}

/// The introduction said that any key starts; who has read it for longer than it stands presses Space.
bool Game::comes_late_to_begin(const Key& key) {
  if (!settings_.begun_by_itself || key.action == KeyAction::kRelease) return false;
  settings_.begun_by_itself = false;
  if (session_.room().pilot() == nullptr || bindings_.keys().find(key) != Control::kCruise ||
      steady_clock::now() - begun_ > kStillReading)
    return false;
  session_.room().notice("you play already: once more, and it cruises", steady_clock::now());
  return true;
}

void Game::on_key(const Key& key) {
  if (comes_late_to_begin(key)) return loop_.hurry();
  if (session_.is_trying() && !interface_.chatting && is_leaving(key, bindings_.keys()))
    return loop_.finish({});
  if (interface_.chatting && !control_action(key)) {
    bindings_.observe(key);
    // A push begun before the chat was opened still ends with its key.
    if (key.action == KeyAction::kRelease) {
      if (const auto action = bindings_.on_key(key, interface_.overlay)) perform(*action);
    } else {
      close_chat(chat_.type(key));
    }
    return loop_.hurry();
  }
  if (key.code == KeyCode::kEscape && interface_.overlay == Overlay::kNone && teacher_.dismiss())
    return loop_.hurry();
  if (const auto action = bindings_.on_key(key, interface_.overlay)) {
    if (key.action != KeyAction::kRelease && !bindings_.release_seen())
      repeat_delay_.observe(key, steady_clock::now());
    perform(*action);
    loop_.hurry();
  }
}

Handling Game::handling() const {
  return {interface_.steer, up_in_picture(interface_.view, settings_.look), repeat_delay_.pulse(),
          bindings_.release_seen()};
}

void Game::close_chat(ChatEntry::Outcome outcome) {
  if (outcome == ChatEntry::Outcome::kTyping) return;
  if (outcome == ChatEntry::Outcome::kSend) {
    if (session_.is_trying()) return;  // it stands there until it can be said
    session_.room().say(chat_.text());
  }
  interface_.chatting = false;
  chat_.clear();
}

void Game::perform(Action action) {
  const core::Time now = steady_clock::now();
  if (Pilot* pilot = session_.room().pilot();
      pilot != nullptr && drive(action, handling(), pilot->steering(), now))
    return;
  if (action == Action::kSteer && session_.room().pilot() == nullptr) return;  // who watches steers nothing
  if (action == Action::kError && !has_error(session_.room()))
    return session_.room().notice(words::no_error(session_.room()), now);
  if (interface_.apply(action)) {
    if (action != Action::kSteer) return;
    if (Pilot* pilot = session_.room().pilot())
      pilot->steering().reset();  // a key that is held means something else now
    session_.room().notice(interface_.steer == SteerBy::kCompass
                               ? "the keys push that way in the picture now"
                               : "the keys push along your heading and turn it now",
                           now);
    return;
  }
  switch (action) {
    case Action::kRespawn:
      session_.room().respawn();
      break;
    case Action::kGhost:
      if (session_.room().pilot() != nullptr)
        session_.room().notice(session_.room().own_game().ghosts().cycle(), steady_clock::now());
      break;
    case Action::kGate:
      session_.room().set_gate(steady_clock::now());
      break;
    case Action::kNextLouse:
      interface_.follow_id =
          next_louse(session_.room().sight(), followed(session_.room().sight(), interface_.follow_id));
      break;
    case Action::kConfirm:
      loop_.finish({});
      break;
    case Action::kQuitNow:
      loop_.finish({kExitInterrupted, ""});
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

Scene Game::scene(core::Time now, double fps) {
  if (const auto* welcome = session_.room().welcome(); welcome != nullptr)
    driven_ = welcome->id == 0 ? state::Mode::kRoam
                               : state::mode_from_text(welcome->mode).value_or(state::Mode::kRoam);
  interface_.suit(default_view(settings_.look, terminal_size(STDOUT_FILENO), driven_));
  if (const auto* welcome = session_.room().welcome(); welcome != nullptr && welcome->id != 0)
    session_.room().look(outlook(interface_, welcome->extent, session_.room().roster().lice()));
  if (Pilot* pilot = session_.room().pilot())
    pilot->steering().look_along(up_in_picture(interface_.view, settings_.look));
  session_.update(now);
  check_server(now);
  if (std::exchange(rung_, session_.room().bells()) != session_.room().bells() && settings_.bell)
    screen_.ring();
  const auto error = own_error(session_.room(), interface_.error);
  Scene scene =
      build_scene(session_, interface_, chat_, {settings_.look, fps, bindings_.release_seen(), now});
  scene.hud.asks_error = interface_.error && has_error(session_.room());
  scene.hud.error = error;
  scene.keys = bindings_.keys().labels();
  scene.keys.compass = interface_.steer == SteerBy::kCompass;
  scene.keys.pulse_seconds = std::chrono::duration<double>(repeat_delay_.pulse()).count();
  teacher_.observe(session_.room().sight(), now);
  scene.course.lesson = teacher_.lines(scene.keys, way_to_goal(scene));
  return scene;
}

void Game::check_server(core::Time now) {
  if (session_.failure()) {
    const core::Error& error = *session_.failure();
    loop_.finish(
        {kExitUnreachable, "woodlouse: " + error.where + ": " + error.what + "\n      " + error.hint + "\n"});
  } else if (server_alive_ && now - server_seen_ >= kServerCheck) {
    server_seen_ = now;
    if (!server_alive_()) loop_.finish({kExitUnreachable, "woodlouse: the server started here has ended\n"});
  }
}

}  // namespace woodlouse::client
