#include "client/watch/replay_keys.h"

#include "client/terminal/key_places.h"

namespace woodlouse::client {
namespace {

/// Shift counts; on other alphabets' layouts the key in that place.
char32_t character_of(const Key& key) {
  if (key.character <= 0x7e) return key.character;
  if (key.physical != 0) return key.physical;
  const char32_t place = place_on_us_keyboard(key.character);
  return place != 0 ? place : key.character;
}

std::optional<ReplayCommand> character_command(char32_t character) {
  switch (character) {
    case U' ':
      return ReplayCommand::kPlayPause;
    case U'<':
      return ReplayCommand::kSkipBack;
    case U'>':
      return ReplayCommand::kSkipForth;
    case U',':
      return ReplayCommand::kTickBack;
    case U'.':
      return ReplayCommand::kTickForth;
    case U'[':
      return ReplayCommand::kSlower;
    case U']':
      return ReplayCommand::kFaster;
    case U'f':
      return ReplayCommand::kFollowNext;
    case U'F':
      return ReplayCommand::kFollowPrevious;
    case U'n':
      return ReplayCommand::kNextEvent;
    case U'N':
      return ReplayCommand::kPreviousEvent;
    case U'q':
    case U'Q':
      return ReplayCommand::kLeave;
    default:
      return std::nullopt;
  }
}

std::optional<ReplayCommand> command_of(const Key& key) {
  switch (key.code) {
    case KeyCode::kCharacter:
      return character_command(character_of(key));
    case KeyCode::kLeft:
      return ReplayCommand::kSkipBack;
    case KeyCode::kRight:
      return ReplayCommand::kSkipForth;
    case KeyCode::kDown:
      return ReplayCommand::kSlower;
    case KeyCode::kUp:
      return ReplayCommand::kFaster;
    case KeyCode::kHome:
      return ReplayCommand::kBeginning;
    case KeyCode::kEnd:
      return ReplayCommand::kEnd;
    default:
      return std::nullopt;
  }
}

bool may_repeat(ReplayCommand command) {
  return command == ReplayCommand::kSkipBack || command == ReplayCommand::kSkipForth ||
         command == ReplayCommand::kTickBack || command == ReplayCommand::kTickForth;
}

}  // namespace

std::optional<ReplayKey> on_replay_key(const Key& key, Overlay overlay) {
  if (const auto action = control_action(key)) return *action;
  if (key.action == KeyAction::kRelease || key.control || key.alt) return std::nullopt;
  const bool repeat = key.action == KeyAction::kRepeat;
  if (overlay == Overlay::kHelp) return repeat ? std::nullopt : std::optional<ReplayKey>(Action::kClose);
  if (key.code == KeyCode::kEscape && overlay == Overlay::kScoreboard) return Action::kClose;
  if (const auto command = command_of(key)) {
    if (repeat && !may_repeat(*command)) return std::nullopt;
    return ReplayOrder{*command, 0};
  }
  if (repeat) return std::nullopt;
  if (key.code == KeyCode::kCharacter && key.character >= U'0' && key.character <= U'9')
    return ReplayOrder{ReplayCommand::kJump, static_cast<int>(key.character - U'0')};
  if (const auto action = picture_action(key)) return *action;
  return std::nullopt;
}

}  // namespace woodlouse::client
