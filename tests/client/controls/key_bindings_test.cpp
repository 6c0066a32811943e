#include "client/controls/key_bindings.h"

#include <catch2/catch.hpp>

#include "client/play/chat_entry.h"
#include "client/play/interface.h"

using namespace woodlouse::client;

namespace {

Key letter(char32_t c, KeyAction action = KeyAction::kPress) { return {.character = c, .action = action}; }

}  // namespace

TEST_CASE("letters and arrows steer alike, capitals too") {
  KeyBindings keys;
  REQUIRE(keys.on_key(letter(U'w'), Overlay::kNone) == Action::kPushPulse);
  REQUIRE(keys.on_key(letter(U'W'), Overlay::kNone) == Action::kPushPulse);
  REQUIRE(keys.on_key({.code = KeyCode::kUp}, Overlay::kNone) == Action::kPushPulse);
  REQUIRE(keys.on_key({.code = KeyCode::kDown}, Overlay::kNone) == Action::kBrakePulse);
  REQUIRE(keys.on_key({.code = KeyCode::kLeft}, Overlay::kNone) == Action::kTurnLeft);
  REQUIRE(keys.on_key(letter(U'd'), Overlay::kNone) == Action::kTurnRight);
  REQUIRE(keys.on_key({.character = 1094, .physical = U'w'}, Overlay::kNone) == Action::kPushPulse);
}

TEST_CASE("holding a key is trusted only once a release was seen") {
  KeyBindings keys;
  REQUIRE(keys.on_key(letter(U'w'), Overlay::kNone) == Action::kPushPulse);
  REQUIRE_FALSE(keys.release_seen());
  REQUIRE(keys.on_key(letter(U'w', KeyAction::kRelease), Overlay::kNone) == Action::kPushRelease);
  REQUIRE(keys.release_seen());
  REQUIRE(keys.on_key(letter(U'w'), Overlay::kNone) == Action::kPushHold);
}

TEST_CASE("a release of any key, even one typed into the chat, shows that releases are reported") {
  KeyBindings keys;
  keys.observe(letter(U'x', KeyAction::kRelease));
  REQUIRE(keys.on_key(letter(U's'), Overlay::kNone) == Action::kBrakeHold);
}

TEST_CASE("a push ends with its release whatever lies over the game") {
  KeyBindings keys;
  for (const Overlay overlay : {Overlay::kHelp, Overlay::kScoreboard, Overlay::kQuitQuestion}) {
    REQUIRE(keys.on_key(letter(U'w', KeyAction::kRelease), overlay) == Action::kPushRelease);
  }
}

TEST_CASE("q asks, and at the question only y, q and Enter leave") {
  KeyBindings keys;
  REQUIRE(keys.on_key(letter(U'q'), Overlay::kNone) == Action::kAskQuit);
  REQUIRE(keys.on_key(letter(U'y'), Overlay::kQuitQuestion) == Action::kConfirm);
  REQUIRE(keys.on_key(letter(U'q'), Overlay::kQuitQuestion) == Action::kConfirm);
  REQUIRE(keys.on_key({.code = KeyCode::kEnter}, Overlay::kQuitQuestion) == Action::kConfirm);
  REQUIRE(keys.on_key(letter(U'n'), Overlay::kQuitQuestion) == Action::kClose);
  REQUIRE(keys.on_key({.code = KeyCode::kEscape}, Overlay::kQuitQuestion) == Action::kClose);
}

TEST_CASE("a q that is held down does not answer its own question") {
  KeyBindings keys;
  REQUIRE_FALSE(keys.on_key(letter(U'q', KeyAction::kRepeat), Overlay::kQuitQuestion));
}

TEST_CASE("E asks how far the steps err, and asks no more") {
  KeyBindings keys;
  Interface interface;
  CHECK_FALSE(interface.error);
  REQUIRE(keys.on_key(letter(U'e'), Overlay::kNone) == Action::kError);
  CHECK(interface.apply(Action::kError));
  CHECK(interface.error);
  CHECK(interface.apply(Action::kError));
  CHECK_FALSE(interface.error);
}

TEST_CASE("any key closes the help, and the louse can be driven under the scoreboard") {
  KeyBindings keys;
  REQUIRE(keys.on_key(letter(U'x'), Overlay::kHelp) == Action::kClose);
  REQUIRE(keys.on_key(letter(U'w'), Overlay::kScoreboard) == Action::kPushPulse);
  REQUIRE(keys.on_key({.code = KeyCode::kEscape}, Overlay::kScoreboard) == Action::kClose);
}

TEST_CASE("Ctrl-C leaves at once, over everything") {
  KeyBindings keys;
  const Key interrupt{.character = U'c', .control = true};
  for (const Overlay overlay :
       {Overlay::kNone, Overlay::kHelp, Overlay::kScoreboard, Overlay::kQuitQuestion}) {
    REQUIRE(keys.on_key(interrupt, overlay) == Action::kQuitNow);
  }
}

TEST_CASE("four times V comes back to the first view") {
  Interface interface;
  for (int i = 0; i < 4; ++i) REQUIRE(interface.apply(Action::kView));
  REQUIRE(interface.view == View::kMap);
}

TEST_CASE("V shows another picture each time, where the look has no oblique view too") {
  Interface interface;
  interface.has_oblique = false;
  for (const View next : {View::kFollow, View::kSlope, View::kMap}) {
    REQUIRE(interface.apply(Action::kView));
    REQUIRE(interface.view == next);
  }
}

TEST_CASE("zooming in follows the louse, zooming out far enough shows the whole map again") {
  Interface interface;
  interface.apply(Action::kZoomOut);
  REQUIRE(interface.view == View::kMap);
  for (int i = 0; i < 50; ++i) interface.apply(Action::kZoomIn);
  REQUIRE(interface.view == View::kFollow);
  REQUIRE(interface.zoom == Interface::kNearest);
  for (int i = 0; i < 50; ++i) interface.apply(Action::kZoomOut);
  REQUIRE(interface.view == View::kMap);
}

TEST_CASE("the view is what suits the terminal until the player chooses one") {
  for (const Action choice : {Action::kView, Action::kZoomIn}) {
    Interface interface;
    interface.suit(View::kOblique);
    CHECK(interface.view == View::kOblique);
    interface.apply(Action::kLabels);
    interface.apply(Action::kZoomOut);  // nothing to zoom out of
    interface.suit(View::kMap);
    CHECK(interface.view == View::kMap);
    interface.apply(choice);
    const View chosen = interface.view;
    CHECK(chosen != View::kMap);
    interface.suit(View::kMap);
    CHECK(interface.view == chosen);
  }
}

TEST_CASE("steering is not the picture's business") {
  Interface interface;
  REQUIRE_FALSE(interface.apply(Action::kPushPulse));
  REQUIRE_FALSE(interface.apply(Action::kRespawn));
}

TEST_CASE("the chat takes UTF-8, erases whole characters, sends with Enter and cancels with Escape") {
  ChatEntry chat;
  chat.type(letter(U'h'));
  chat.type(letter(U'\u00e4'));
  chat.type(letter(U'\U0001f41b'));
  chat.type({.code = KeyCode::kBackspace});
  REQUIRE(chat.text() == "h\u00e4");
  REQUIRE(chat.type(letter(U'x', KeyAction::kRelease)) == ChatEntry::Outcome::kTyping);
  REQUIRE(chat.text() == "h\u00e4");
  REQUIRE(chat.type({.code = KeyCode::kEnter}) == ChatEntry::Outcome::kSend);
  REQUIRE(chat.type({.code = KeyCode::kEscape}) == ChatEntry::Outcome::kCancel);
}

TEST_CASE("an empty chat line is not sent") {
  ChatEntry chat;
  REQUIRE(chat.type({.code = KeyCode::kEnter}) == ChatEntry::Outcome::kCancel);
}

TEST_CASE("a paste into the chat is cut at the wire's limit between characters and loses its controls") {
  ChatEntry chat;
  chat.paste("one\ntwo\x1b[31m\x03 three");
  REQUIRE(chat.text() == "one two three");
  std::string many;
  for (int i = 0; i < 300; ++i) many += "\u20ac";
  chat.clear();
  chat.paste(many);
  REQUIRE(chat.text() == many.substr(0, 399));
}

TEST_CASE("keys of other alphabets count by their place, in the game and in questions") {
  KeyBindings keys;
  for (const char32_t c : {U'ц', U'Ц', U'ς', U'ص'})
    CHECK(keys.on_key(letter(c), Overlay::kNone) == Action::kPushPulse);
  for (const char32_t c : {U'ф', U'Α', U'α', U'ש'})
    CHECK(keys.on_key(letter(c), Overlay::kNone) == Action::kTurnLeft);
  CHECK(keys.on_key(letter(U'ы'), Overlay::kNone) == Action::kBrakePulse);
  CHECK(keys.on_key(letter(U'і'), Overlay::kNone) == Action::kBrakePulse);
  CHECK(keys.on_key(letter(U'й'), Overlay::kNone) == Action::kAskQuit);
  CHECK(keys.on_key(letter(U'й'), Overlay::kQuitQuestion) == Action::kConfirm);
  CHECK(keys.on_key(letter(U'н'), Overlay::kQuitQuestion) == Action::kConfirm);
  CHECK(keys.on_key({.character = U'ф', .physical = U'w'}, Overlay::kNone) == Action::kPushPulse);
}

TEST_CASE("the number pad drives as the arrows do") {
  KeyBindings keys;
  CHECK(keys.on_key(letter(U'8'), Overlay::kNone) == Action::kPushPulse);
  CHECK(keys.on_key(letter(U'2'), Overlay::kNone) == Action::kBrakePulse);
  CHECK(keys.on_key(letter(U'4'), Overlay::kNone) == Action::kTurnLeft);
  CHECK(keys.on_key(letter(U'6'), Overlay::kNone) == Action::kTurnRight);
}

TEST_CASE("keys that the config file names rule, and nothing else has them any more") {
  KeyMap map;
  REQUIRE(map.bind("up", {"z", "Up"}));
  REQUIRE(map.bind("left", {"q"}));
  CHECK(map.is_complete().error().where == "quit");
  REQUIRE(map.bind("quit", {"End", "ö"}));
  REQUIRE(map.is_complete());
  KeyBindings keys(map);
  CHECK(keys.on_key(letter(U'z'), Overlay::kNone) == Action::kPushPulse);
  CHECK(keys.on_key(letter(U'Q'), Overlay::kNone) == Action::kTurnLeft);
  CHECK_FALSE(keys.on_key(letter(U'w'), Overlay::kNone));
  CHECK(keys.on_key({.code = KeyCode::kEnd}, Overlay::kNone) == Action::kAskQuit);
  CHECK(keys.on_key(letter(U'ö'), Overlay::kQuitQuestion) == Action::kConfirm);
  CHECK(map.labels().up == "Z");
  CHECK(map.labels().up2 == "Up");
  CHECK(map.labels().quit == "End");
  CHECK(map.bind("fly", {"f"}).error().hint.find("known: up down") == 0);
  CHECK(map.bind("chat", {"Space bar"}).error().hint.find("one character, or Space Up") == 0);
  CHECK(map.bind("chat", {"z"}).error().what == "\"z\" is bound twice");
  CHECK(map.bind("chat", {}).error().what == "it has no key");
}
