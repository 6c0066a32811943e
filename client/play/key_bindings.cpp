#include "client/play/key_bindings.h"

namespace woodlouse::client {
namespace {

enum class Drive : std::uint8_t { kNone, kPush, kBrake, kLeft, kRight };

/// The letter a binding goes by: lower case; on other alphabets' layouts the key in that place.
char32_t letter(const Key& key) {
  char32_t c = key.character;
  if (c > 0x7e && key.physical != 0) c = key.physical;
  return c >= U'A' && c <= U'Z' ? c + (U'a' - U'A') : c;
}

Drive drive(const Key& key) {
  switch (key.code) {
    case KeyCode::kUp:
      return Drive::kPush;
    case KeyCode::kDown:
      return Drive::kBrake;
    case KeyCode::kLeft:
      return Drive::kLeft;
    case KeyCode::kRight:
      return Drive::kRight;
    case KeyCode::kCharacter:
      break;
    default:
      return Drive::kNone;
  }
  switch (letter(key)) {
    case U'w':
      return Drive::kPush;
    case U's':
      return Drive::kBrake;
    case U'a':
      return Drive::kLeft;
    case U'd':
      return Drive::kRight;
    default:
      return Drive::kNone;
  }
}

std::optional<Action> play_action(const Key& key) {
  if (const auto action = picture_action(key)) return action;
  if (key.code != KeyCode::kCharacter) return std::nullopt;
  switch (letter(key)) {
    case U' ':
      return Action::kCruise;
    case U'r':
      return Action::kRespawn;
    case U't':
      return Action::kChat;
    case U'n':
      return Action::kNextLouse;
    case U'q':
      return Action::kAskQuit;
    default:
      return std::nullopt;
  }
}

std::optional<Action> question_action(const Key& key) {
  if (key.code == KeyCode::kEnter) return Action::kConfirm;
  if (key.code == KeyCode::kCharacter && (letter(key) == U'y' || letter(key) == U'q'))
    return Action::kConfirm;
  return Action::kClose;
}

}  // namespace

std::optional<Action> picture_action(const Key& key) {
  if (key.code == KeyCode::kTab) return Action::kScoreboard;
  if (key.code != KeyCode::kCharacter) return std::nullopt;
  switch (letter(key)) {
    case U'v':
      return Action::kView;
    case U'?':
    case U'h':
      return Action::kHelp;
    case U'l':
      return Action::kLabels;
    case U'p':
      return Action::kTrails;
    case U'+':
    case U'=':
      return Action::kZoomIn;
    case U'-':
    case U'_':
      return Action::kZoomOut;
    default:
      return std::nullopt;
  }
}

std::optional<Action> control_action(const Key& key) {
  if (key.action == KeyAction::kRelease || !key.control || key.code != KeyCode::kCharacter)
    return std::nullopt;
  switch (letter(key)) {
    case U'c':
      return Action::kQuitNow;
    case U'z':
      return Action::kSuspend;
    case U'l':
      return Action::kRedraw;
    default:
      return std::nullopt;
  }
}

bool is_leaving(const Key& key) {
  if (key.action == KeyAction::kRelease || key.control || key.alt) return false;
  return key.code == KeyCode::kEscape || (key.code == KeyCode::kCharacter && letter(key) == U'q');
}

std::optional<Action> KeyBindings::on_key(const Key& key, Overlay overlay) {
  observe(key);
  if (const auto action = control_action(key)) return action;
  const Drive driving = key.control || key.alt ? Drive::kNone : drive(key);
  if (key.action == KeyAction::kRelease) {  // counts whatever lies over the game: else a push would never end
    if (driving == Drive::kPush) return Action::kPushRelease;
    if (driving == Drive::kBrake) return Action::kBrakeRelease;
    return std::nullopt;
  }
  if (key.control || key.alt) return std::nullopt;

  const bool repeat = key.action == KeyAction::kRepeat;
  if (overlay == Overlay::kQuitQuestion) return repeat ? std::nullopt : question_action(key);
  if (overlay == Overlay::kHelp) return repeat ? std::nullopt : std::optional(Action::kClose);
  // The scoreboard is looked at while driving; it closes by its own key or Escape.
  if (key.code == KeyCode::kEscape && overlay == Overlay::kScoreboard) return Action::kClose;

  switch (driving) {
    case Drive::kPush:
      return release_seen_ ? Action::kPushHold : Action::kPushPulse;
    case Drive::kBrake:
      return release_seen_ ? Action::kBrakeHold : Action::kBrakePulse;
    case Drive::kLeft:
      return Action::kTurnLeft;
    case Drive::kRight:
      return Action::kTurnRight;
    case Drive::kNone:
      break;
  }
  return repeat ? std::nullopt : play_action(key);
}

}  // namespace woodlouse::client
