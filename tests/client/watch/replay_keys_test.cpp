#include "client/watch/replay_keys.h"

#include <catch2/catch.hpp>

using namespace woodlouse::client;

namespace {

Key letter(char32_t c, KeyAction action = KeyAction::kPress) { return {.character = c, .action = action}; }

std::optional<ReplayKey> order(ReplayCommand command, int tenths = 0) { return ReplayOrder{command, tenths}; }

}  // namespace

TEST_CASE("the keys of the key line do what it says") {
  using C = ReplayCommand;
  for (const auto& [character, command] : {std::pair{U' ', C::kPlayPause},
                                           {U'<', C::kSkipBack},
                                           {U'>', C::kSkipForth},
                                           {U',', C::kTickBack},
                                           {U'.', C::kTickForth},
                                           {U'[', C::kSlower},
                                           {U']', C::kFaster},
                                           {U'f', C::kFollowNext},
                                           {U'F', C::kFollowPrevious},
                                           {U'n', C::kNextEvent},
                                           {U'N', C::kPreviousEvent},
                                           {U'q', C::kLeave}})
    CHECK(on_replay_key(letter(character), Overlay::kNone) == order(command));
  CHECK(on_replay_key({.code = KeyCode::kLeft}, Overlay::kNone) == order(C::kSkipBack));
  CHECK(on_replay_key({.code = KeyCode::kRight}, Overlay::kNone) == order(C::kSkipForth));
  CHECK(on_replay_key({.code = KeyCode::kHome}, Overlay::kNone) == order(C::kBeginning));
  CHECK(on_replay_key({.code = KeyCode::kEnd}, Overlay::kNone) == order(C::kEnd));
  for (int digit = 0; digit < 10; ++digit)
    CHECK(on_replay_key(letter(U'0' + static_cast<char32_t>(digit)), Overlay::kNone) ==
          order(C::kJump, digit));
}

TEST_CASE("the picture's keys are the game's, and what only a player does has no key") {
  CHECK(on_replay_key(letter(U'v'), Overlay::kNone) == ReplayKey(Action::kView));
  CHECK(on_replay_key(letter(U'l'), Overlay::kNone) == ReplayKey(Action::kLabels));
  CHECK(on_replay_key(letter(U'+'), Overlay::kNone) == ReplayKey(Action::kZoomIn));
  CHECK(on_replay_key({.code = KeyCode::kTab}, Overlay::kNone) == ReplayKey(Action::kScoreboard));
  for (const char32_t c : {U'w', U'a', U's', U'd', U'r', U't'})
    CHECK_FALSE(on_replay_key(letter(c), Overlay::kNone));
}

TEST_CASE("skips and single ticks repeat while a key is held, other keys do not, releases do nothing") {
  CHECK(on_replay_key(letter(U'.', KeyAction::kRepeat), Overlay::kNone) == order(ReplayCommand::kTickForth));
  CHECK(on_replay_key(letter(U'<', KeyAction::kRepeat), Overlay::kNone) == order(ReplayCommand::kSkipBack));
  CHECK_FALSE(on_replay_key(letter(U' ', KeyAction::kRepeat), Overlay::kNone));
  CHECK_FALSE(on_replay_key(letter(U'5', KeyAction::kRepeat), Overlay::kNone));
  CHECK_FALSE(on_replay_key(letter(U' ', KeyAction::kRelease), Overlay::kNone));
}

TEST_CASE("any key closes the help and does nothing else, Escape closes the scores, Ctrl-C works over both") {
  CHECK(on_replay_key(letter(U'q'), Overlay::kHelp) == ReplayKey(Action::kClose));
  CHECK(on_replay_key({.code = KeyCode::kEscape}, Overlay::kScoreboard) == ReplayKey(Action::kClose));
  CHECK(on_replay_key(letter(U' '), Overlay::kScoreboard) == order(ReplayCommand::kPlayPause));
  const Key interrupt{.character = U'c', .control = true};
  for (const Overlay overlay : {Overlay::kNone, Overlay::kHelp, Overlay::kScoreboard})
    CHECK(on_replay_key(interrupt, overlay) == ReplayKey(Action::kQuitNow));
}

TEST_CASE("on another alphabet's layout the letters are the keys in their places") {
  CHECK(on_replay_key({.character = 1072, .physical = U'f'}, Overlay::kNone) ==
        order(ReplayCommand::kFollowNext));
}
