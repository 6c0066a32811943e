// What each key does, by what is on the screen. Also where it is learnt whether the terminal reports
// releases: a terminal may claim the kitty protocol and swallow releases (tmux does), so a hold is trusted
// only once a release has been seen. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "client/controls/key_map.h"
#include "client/terminal/keyboard.h"

namespace woodlouse::client {

enum class Action : std::uint8_t {
  kPushPulse,  ///< W, Up: for a pulse; repeats extend it
  kPushHold,   ///< the same where releases are known: until kPushRelease
  kPushRelease,
  kBrakePulse,  ///< S, Down
  kBrakeHold,
  kBrakeRelease,
  kTurnLeft,  ///< A, Left: counter-clockwise on the map
  kTurnLeftRelease,
  kTurnRight,  ///< D, Right
  kTurnRightRelease,
  kStopPulse,  ///< X: brakes, however it is steered
  kStopHold,
  kStopRelease,
  kSteer,       ///< C: by the heading, or by the compass (Steering)
  kCruise,      ///< Space: latches the push
  kRespawn,     ///< R
  kGhost,       ///< G: best, last, off
  kGate,        ///< B: a gate of one's own
  kChat,        ///< T
  kScoreboard,  ///< Tab
  kView,        ///< V
  kHelp,        ///< ?
  kLabels,      ///< L
  kTrails,      ///< P
  kZoomIn,      ///< +
  kZoomOut,     ///< -
  kError,       ///< E: how far the steps err
  kNextLouse,   ///< N: whom a spectator follows
  kAskQuit,     ///< Q
  kQuitNow,     ///< Ctrl-C
  kSuspend,     ///< Ctrl-Z
  kRedraw,      ///< Ctrl-L
  kClose,       ///< closes what lies over the game: a question, help, the scoreboard
  kConfirm,     ///< Y or Q at the question
};

/// What lies over the game and so decides what a key means. Chat is not here: it takes text (chat_entry.h).
enum class Overlay : std::uint8_t { kNone, kHelp, kScoreboard, kQuitQuestion };

class KeyBindings {
 public:
  explicit KeyBindings(KeyMap keys = {}) : keys_(std::move(keys)) {}

  [[nodiscard]] const KeyMap& keys() const { return keys_; }
  /// What the key does now; nothing for keys without a meaning.
  std::optional<Action> on_key(const Key& key, Overlay overlay);
  /// Watches for releases only: for keys that went elsewhere (into the chat).
  void observe(const Key& key) { release_seen_ = release_seen_ || key.action == KeyAction::kRelease; }
  /// Whether this terminal was ever seen to report a key's release.
  [[nodiscard]] bool release_seen() const { return release_seen_; }

 private:
  KeyMap keys_;
  bool release_seen_ = false;
};

/// What works over everything, the chat included: Ctrl-C, Ctrl-Z, Ctrl-L.
std::optional<Action> control_action(const Key& key);

/// Quit's key or Escape: leaves unasked where there is nothing to leave, the connection being lost.
bool is_leaving(const Key& key, const KeyMap& keys = {});

/// What changes only the picture, in the game as in a recording: V, L, P, E, + and -, Tab, help.
std::optional<Action> picture_action(const Key& key, const KeyMap& keys = {});

}  // namespace woodlouse::client
