#include "client/controls/key_bindings.h"

namespace woodlouse::client {
namespace {

/// What a key that drives does, pressed and where releases are known, and let go.
struct Driving {
  Action pulse, hold, release;
};

std::optional<Driving> driving_of(std::optional<Control> control) {
  if (!control) return std::nullopt;
  switch (*control) {
    case Control::kUp:
      return Driving{Action::kPushPulse, Action::kPushHold, Action::kPushRelease};
    case Control::kDown:
      return Driving{Action::kBrakePulse, Action::kBrakeHold, Action::kBrakeRelease};
    case Control::kLeft:
      return Driving{Action::kTurnLeft, Action::kTurnLeft, Action::kTurnLeftRelease};
    case Control::kRight:
      return Driving{Action::kTurnRight, Action::kTurnRight, Action::kTurnRightRelease};
    case Control::kBrake:
      return Driving{Action::kStopPulse, Action::kStopHold, Action::kStopRelease};
    default:
      return std::nullopt;
  }
}

std::optional<Action> play_action(const Key& key, const KeyMap& keys) {
  if (const auto action = picture_action(key, keys)) return action;
  switch (keys.find(key).value_or(Control::kUp)) {
    case Control::kCruise:
      return Action::kCruise;
    case Control::kRespawn:
      return Action::kRespawn;
    case Control::kGhost:
      return Action::kGhost;
    case Control::kGate:
      return Action::kGate;
    case Control::kChat:
      return Action::kChat;
    case Control::kNext:
      return Action::kNextLouse;
    case Control::kSteer:
      return Action::kSteer;
    case Control::kQuit:
      return Action::kAskQuit;
    default:
      return std::nullopt;
  }
}

bool is_letter(const Key& key, char32_t letter) {
  return key.code == KeyCode::kCharacter && letter_of(key) == letter;
}

/// The question says Y; the key that asked it says it, too.
Action question_action(const Key& key, const KeyMap& keys) {
  const bool leaves = key.code == KeyCode::kEnter || is_letter(key, U'y') || is_letter(key, U'q') ||
                      keys.find(key) == Control::kQuit;
  return leaves ? Action::kConfirm : Action::kClose;
}

}  // namespace

std::optional<Action> picture_action(const Key& key, const KeyMap& keys) {
  switch (keys.find(key).value_or(Control::kUp)) {
    case Control::kScores:
      return Action::kScoreboard;
    case Control::kView:
      return Action::kView;
    case Control::kHelp:
      return Action::kHelp;
    case Control::kLabels:
      return Action::kLabels;
    case Control::kTrails:
      return Action::kTrails;
    case Control::kError:
      return Action::kError;
    case Control::kZoomIn:
      return Action::kZoomIn;
    case Control::kZoomOut:
      return Action::kZoomOut;
    default:
      return std::nullopt;
  }
}

std::optional<Action> control_action(const Key& key) {
  if (key.action == KeyAction::kRelease || !key.control || key.code != KeyCode::kCharacter)
    return std::nullopt;
  switch (letter_of(key)) {
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

bool is_leaving(const Key& key, const KeyMap& keys) {
  if (key.action == KeyAction::kRelease || key.control || key.alt) return false;
  return key.code == KeyCode::kEscape || keys.find(key) == Control::kQuit;
}

std::optional<Action> KeyBindings::on_key(const Key& key, Overlay overlay) {
  observe(key);
  if (const auto action = control_action(key)) return action;
  const auto driving = key.control || key.alt ? std::nullopt : driving_of(keys_.find(key));
  if (key.action == KeyAction::kRelease)  // counts whatever lies over the game: else a push would never end
    return driving ? std::optional(driving->release) : std::nullopt;
  if (key.control || key.alt) return std::nullopt;

  const bool repeat = key.action == KeyAction::kRepeat;
  if (overlay == Overlay::kQuitQuestion)
    return repeat ? std::nullopt : std::optional(question_action(key, keys_));
  if (overlay == Overlay::kHelp) return repeat ? std::nullopt : std::optional(Action::kClose);
  // The scoreboard is looked at while driving; it closes by its own key or Escape.
  if (key.code == KeyCode::kEscape && overlay == Overlay::kScoreboard) return Action::kClose;
  if (driving) return release_seen_ ? driving->hold : driving->pulse;
  return repeat ? std::nullopt : play_action(key, keys_);
}

}  // namespace woodlouse::client
