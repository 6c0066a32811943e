#include "client/cells/cell_buffer.h"

#include <catch2/catch.hpp>

#include "client/cells/character_width.h"
#include "client/drawing/wrapping.h"
#include "client/play/trail.h"
#include "shared/core/random.h"
#include "shared/core/utf8.h"

using namespace woodlouse;
using namespace woodlouse::client;

TEST_CASE("every byte string becomes printable code points, one element a column") {
  core::Random random(7);
  for (int round = 0; round < 20000; ++round) {
    std::string bytes;
    for (std::uint64_t n = random.next() % 12; n > 0; --n) bytes.push_back(static_cast<char>(random.next()));
    for (const char32_t c : printable(bytes, GlyphSet::kAscii)) REQUIRE((c >= 0x20 && c < 0x7F));
    for (const char32_t c : printable(bytes, GlyphSet::kHalfBlocks)) {
      REQUIRE((c == kWideTail || columns_of(c) == 1 || columns_of(c) == 2));
      REQUIRE((c == kWideTail || (c >= 0x20 && c < 0x7F) || c >= 0xA1));
      REQUIRE_FALSE((c >= 0x300 && c < 0x370));
    }
  }
}

TEST_CASE(
    "letters of Europe and of East Asia survive, marks join their letter, commands do not get through") {
  CHECK(printable("J\u00FCrgen \u0394 \u0416", GlyphSet::kHalfBlocks) == U"J\u00FCrgen \u0394 \u0416");
  CHECK(printable("J\u00FCrgen \u1EC7 \u6F22\u5B57", GlyphSet::kAscii) == U"Jurgen ? ??");
  CHECK(printable("\u6F22e\u0301\x1b[31m", GlyphSet::kHalfBlocks) ==
        std::u32string(U"\u6F22\0\u00E9?[31m", 8));
  CHECK(printable("\u6F22e\u0301", GlyphSet::kAscii) == U"?e");
  // An emoji with a skin tone and a joiner; letters that are put together; a turn of the direction of
  // writing.
  CHECK(printable("\U0001F44D\U0001F3FD\u200D", GlyphSet::kHalfBlocks) == std::u32string(U"\U0001F44D\0", 2));
  CHECK(printable("\u1112\u1161\u11AB", GlyphSet::kHalfBlocks) == std::u32string(U"\uD55C\0", 2));
  CHECK(printable("\u304B\u3099", GlyphSet::kHalfBlocks) == std::u32string(U"\u304C\0", 2));
  CHECK(printable("a\u202Eb", GlyphSet::kHalfBlocks) == U"ab");
  CHECK(printable("\xC0\x80\xED\xA0\x80", GlyphSet::kHalfBlocks) == U"?????");
}

TEST_CASE("a code point written as UTF-8 reads back") {
  for (const char32_t c : {U'a', U'\u00FC', U'\u0416'}) {
    std::string bytes;
    woodlouse::core::append_character(bytes, c);
    CHECK(printable(bytes, GlyphSet::kHalfBlocks) == std::u32string(1, c));
  }
}

TEST_CASE("writing outside the grid changes nothing") {
  CellBuffer cells({4, 2});
  const CellBuffer blank = cells;
  cells.put(-1, 0, U'x', {});
  cells.put(4, 1, U'x', {});
  cells.put(0, 2, U'x', {});
  cells.fill(-3, -3, {3, 3}, {{}, Color::indexed(3), kPlain});
  cells.text(9, 0, "hello", {});
  CHECK(cells == blank);
  CHECK(cells.text(2, 1, "abc", {}) == 5);
  CHECK(cells.at(3, 1).glyph == U'b');
  CHECK(cells.text(0, 0, "abc", {}, 2) == 2);
  CHECK(cells.at(2, 0).glyph == U' ');
}

TEST_CASE("wrapped lines fit and keep every word") {
  const std::u32string text = U"one two three fourteenlettersandmore five";
  for (int width = 1; width < 50; ++width) {
    std::u32string joined;
    for (const std::u32string& line : wrapped(text, width)) {
      CHECK(line.size() <= static_cast<std::size_t>(width));
      for (const char32_t c : line)
        if (c != U' ') joined.push_back(c);
    }
    CHECK(joined == U"onetwothreefourteenlettersandmorefive");
  }
}

TEST_CASE("a trail keeps points a spacing apart and forgets on a jump") {
  Trail trail(1.0);
  for (int i = 0; i < 1000; ++i) trail.add({0.25 * i, 0.0});
  REQUIRE(trail.points().size() == Trail::kPoints);
  for (std::size_t i = 1; i < trail.points().size(); ++i)
    CHECK(trail.points()[i].x - trail.points()[i - 1].x == Approx(1.0));
  trail.add({-50.0, 0.0});
  CHECK(trail.points().size() == 1);
}

TEST_CASE("half of a wide character is never shown") {
  const std::u32string wide(U"\u6F22\0", 2);
  CellBuffer cells({6, 1});
  const auto shown = [&] {
    std::u32string text;
    for (std::size_t i = 0; i < 6; ++i) text.push_back(whole_cell(cells.row(0), i).glyph);
    return text;
  };
  cells.text(2, 0, wide, {});
  CHECK(shown() == std::u32string(U"  \u6F22\0  ", 6));
  cells.put(3, 0, U'x', {});
  CHECK(shown() == U"   x  ");
  cells.text(2, 0, wide, {});
  cells.put(2, 0, U'x', {});
  CHECK(shown() == U"  x   ");
  cells.clear();
  cells.text(5, 0, wide, {});
  CHECK(shown() == U"      ");
  cells.text(0, 0, wide, {}, 1);
  CHECK(shown() == U"      ");
}

TEST_CASE("a wide character at the end of a line goes to the next one whole") {
  const std::u32string text(U"ab\u6F22\0\u5B57\0", 6);
  for (const std::u32string& line : wrapped(text, 3)) {
    CHECK(line.size() <= 3);
    CHECK(line.front() != kWideTail);
    CHECK(columns_of(line.back()) != 2);
  }
}
