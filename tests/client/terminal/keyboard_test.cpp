#include "client/terminal/keyboard.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/core/utf8.h"

using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

const woodlouse::core::Time kStart{std::chrono::seconds(100)};

std::vector<TerminalInput> keys_of(std::string_view bytes) {
  Keyboard keyboard;
  std::vector<TerminalInput> out;
  keyboard.feed(bytes, kStart, out);
  return out;
}

TerminalInput typed(char32_t c) { return Key{.character = c}; }
TerminalInput named(KeyCode code) { return Key{.code = code}; }

/// Everything a terminal may send, good and bad, in one string.
const std::string kMixture =
    "wasd \x1b[A\x1bOB\x1b[1;5C\t\r\x7f\x03"
    "\x1b[97;1:1u\x1b[97;1:3u\x1b[47:63;2;63u\x1b[1;1:3A\x1b[57441;1:1u"
    "\xc3\xa4\xe2\x82\xac\xf0\x9f\x90\x9b\xff\xc3w\xe2\x82q"
    "\x1b[200~pasted \x1b[31m w \xc3\xa4\n\x1b[201~x\x1b[?31u\x1b[?62;22c\x1b[I\x1b[O\x1b[[Ax\x1b[3~\x1b[Z"
    "\x1b[1234567890123456789012345678901234567890123456789012345678901234567890m!"
    "\x1b\x1b[D\x1bq\x1b";

}  // namespace

TEST_CASE("several keys in one read come out one by one") {
  REQUIRE(keys_of("wA \x1b[A") ==
          std::vector<TerminalInput>{typed(U'w'), typed(U'A'), typed(U' '), named(KeyCode::kUp)});
}

TEST_CASE("arrows are understood in cursor and in application mode") {
  REQUIRE(keys_of("\x1b[A\x1b[B\x1b[C\x1b[D") == keys_of("\x1bOA\x1bOB\x1bOC\x1bOD"));
}

TEST_CASE("splitting the bytes anywhere gives the same keys") {
  const auto whole = keys_of(kMixture);
  REQUIRE(whole.size() > 30);
  for (std::size_t cut = 0; cut <= kMixture.size(); ++cut) {
    Keyboard keyboard;
    std::vector<TerminalInput> out;
    keyboard.feed(std::string_view(kMixture).substr(0, cut), kStart, out);
    keyboard.feed(std::string_view(kMixture).substr(cut), kStart + 1ms, out);
    REQUIRE(out == whole);
  }
}

TEST_CASE("splitting random bytes at random places gives the same keys") {
  woodlouse::core::Random random(7);
  static constexpr std::string_view kLikely = "\x1b\x1b\x1b[[O;:?~uABm0123456789wq\xc3\xa4\xe2\x82\xac";
  for (int round = 0; round < 2000; ++round) {
    std::string bytes;
    while (bytes.size() < 60) {
      const bool likely = random.next() % 4 != 0;
      bytes.push_back(likely ? kLikely[random.next() % kLikely.size()]
                             : static_cast<char>(random.next() & 0xff));
    }
    Keyboard keyboard;
    std::vector<TerminalInput> pieces;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = 1 + random.next() % 5;
      keyboard.feed(std::string_view(bytes).substr(at, size), kStart, pieces);
      at += size;
    }
    REQUIRE(pieces == keys_of(bytes));
  }
}

TEST_CASE("a lone escape is the key only after its timeout") {
  Keyboard keyboard;
  std::vector<TerminalInput> out;
  keyboard.feed("\x1b", kStart, out);
  keyboard.expire(kStart + Keyboard::kEscapeTimeout - 1ms, out);
  REQUIRE(out.empty());
  REQUIRE(keyboard.deadline() == kStart + Keyboard::kEscapeTimeout);
  keyboard.expire(kStart + Keyboard::kEscapeTimeout, out);
  REQUIRE(out == std::vector<TerminalInput>{named(KeyCode::kEscape)});
  REQUIRE_FALSE(keyboard.deadline());
}

TEST_CASE("an arrow whose bytes come 20 ms apart is an arrow") {
  Keyboard keyboard;
  std::vector<TerminalInput> out;
  keyboard.feed("\x1b", kStart, out);
  keyboard.expire(kStart + 20ms, out);
  keyboard.feed("[", kStart + 20ms, out);
  keyboard.expire(kStart + 60ms, out);
  keyboard.feed("A", kStart + 60ms, out);
  REQUIRE(out == std::vector<TerminalInput>{named(KeyCode::kUp)});
}

TEST_CASE("the kitty protocol's presses, repeats and releases are told apart") {
  const auto keys = keys_of("\x1b[119u\x1b[119;1:2u\x1b[119;1:3u\x1b[1;1:3A");
  REQUIRE(keys == std::vector<TerminalInput>{typed(U'w'),
                                             Key{.character = U'w', .action = KeyAction::kRepeat},
                                             Key{.character = U'w', .action = KeyAction::kRelease},
                                             Key{.code = KeyCode::kUp, .action = KeyAction::kRelease}});
}

TEST_CASE("the kitty protocol's text wins over its code, and shift without text gives capitals") {
  REQUIRE(keys_of("\x1b[47:63;2;63u") == std::vector<TerminalInput>{typed(U'?')});
  REQUIRE(keys_of("\x1b[119;2u") == std::vector<TerminalInput>{typed(U'W')});
  REQUIRE(keys_of("\x1b[0;;228u") == std::vector<TerminalInput>{typed(U'\u00e4')});
}

TEST_CASE("a key of another alphabet brings the key in its place along") {
  REQUIRE(keys_of("\x1b[1094::119;;1094u") ==
          std::vector<TerminalInput>{Key{.character = 1094, .physical = U'w'}});
}

TEST_CASE("modifier keys alone and F keys are nobody's") {
  REQUIRE(keys_of("\x1b[57441;2:1u\x1b[57441;1:3u\x1b[15~\x1b[[A\x1bOP").empty());
}

TEST_CASE("Ctrl-C is the same key in both protocols") { REQUIRE(keys_of("\x03") == keys_of("\x1b[99;5u")); }

TEST_CASE("a paste is one text, whatever stands in it, and is cut at its limit") {
  const std::string long_text(5000, 'w');
  const auto out = keys_of("\x1b[200~" + long_text + "\x1b[201~q");
  REQUIRE(out.size() == 2);
  REQUIRE(std::get<Paste>(out[0]).text == long_text.substr(0, Keyboard::kMaxPasteBytes));
  REQUIRE(out[1] == typed(U'q'));
}

TEST_CASE("answers to queries are no keys") {
  REQUIRE(keys_of("\x1b[?0u\x1b[?62;4c") == std::vector<TerminalInput>{KittyFlags{0}, DeviceAttributes{}});
}

TEST_CASE("every code point survives UTF-8") {
  for (char32_t c = 0xa0; c <= 0x10ffff; c += c < 0x3000 ? 1 : 97) {
    if (c >= 0xd800 && c < 0xe000) continue;
    std::string bytes;
    woodlouse::core::append_character(bytes, c);
    REQUIRE(keys_of(bytes) == std::vector<TerminalInput>{typed(c)});
  }
}

TEST_CASE("overlong forms, surrogates and C1 controls are dropped") {
  REQUIRE(keys_of("\xc0\xaf\xe0\x80\xaf\xed\xa0\x80\xf4\x90\x80\x80\xc2\x9bw") ==
          std::vector<TerminalInput>{typed(U'w')});
}

TEST_CASE("the number pad types its digits in both of its modes and in kitty's numbers") {
  REQUIRE(keys_of("\x1bOx\x1bOr\x1bOt\x1bOv") == keys_of("8246"));
  REQUIRE(keys_of("\x1b[57407;1u\x1b[57401;1;50u") == keys_of("82"));
}

TEST_CASE("what answers a question is no key, and what begins like an answer ends with the next control") {
  REQUIRE(keys_of("\x1b[12;3R\x1b[?2026;2$y\x1bP1$r48:2:1:2:3m\x1b\\w") ==
          std::vector<TerminalInput>{CursorReport{12, 3}, ModeReport{2026, 2},
                                     SettingReport{true, "48:2:1:2:3m"}, typed(U'w')});
  REQUIRE(keys_of("\x1b]11;rgb:0/0/0\x07w") == keys_of("w"));
  REQUIRE(keys_of("\x1bPqqq\x03") == keys_of("\x03"));
  REQUIRE(keys_of("\x1bP\x1b[A") == keys_of("\x1b[A"));
}
