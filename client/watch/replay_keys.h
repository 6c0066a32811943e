// What each key does while a recording is watched. What concerns only the picture is the game's (Action).
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "client/controls/key_bindings.h"
#include "client/terminal/keyboard.h"

namespace woodlouse::client {

enum class ReplayCommand : std::uint8_t {
  kPlayPause,       ///< Space
  kSkipBack,        ///< <, Left: 5 s
  kSkipForth,       ///< >, Right
  kTickBack,        ///< comma
  kTickForth,       ///< full stop
  kSlower,          ///< [, Down
  kFaster,          ///< ], Up
  kJump,            ///< 0-9: so many tenths of the recording
  kBeginning,       ///< Home
  kEnd,             ///< End
  kFollowNext,      ///< F
  kFollowPrevious,  ///< Shift-F
  kNextEvent,       ///< N
  kPreviousEvent,   ///< Shift-N
  kLeave,           ///< Q
};

struct ReplayOrder {
  ReplayCommand command = ReplayCommand::kPlayPause;
  int tenths = 0;  ///< of kJump
  friend bool operator==(const ReplayOrder&, const ReplayOrder&) = default;
};

using ReplayKey = std::variant<ReplayOrder, Action>;

/// What the key does now; nothing for keys without a meaning. Held keys repeat skips and single ticks.
std::optional<ReplayKey> on_replay_key(const Key& key, Overlay overlay);

}  // namespace woodlouse::client
