#include "client/cells/color.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "client/drawing/palette.h"
#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

Color random_color(core::Random& random) {
  const std::uint64_t bits = random.next();
  const auto byte = [&](int shift) { return static_cast<std::uint8_t>(bits >> shift); };
  if (byte(0) < 40) return {};
  if (byte(0) < 90) return Color::indexed(byte(8));
  return Color::of({byte(8), byte(16), byte(24)});
}

int distance(Rgb a, Rgb b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

}  // namespace

TEST_CASE("a quantised colour is one the mode can show, and quantising it again changes nothing") {
  core::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const Color color = random_color(random);
    CHECK(quantise(color, ColorMode::kMono) == Color{});
    CHECK(quantise(color, ColorMode::kTruecolor) == color);
    for (const ColorMode mode : {ColorMode::k16, ColorMode::k256}) {
      const Color shown = quantise(color, mode);
      if (color == Color{}) {
        CHECK(shown == Color{});
        continue;
      }
      REQUIRE(shown.kind == Color::Kind::kIndexed);
      if (mode == ColorMode::k16) REQUIRE(shown.index() < 16);
      CHECK(quantise(shown, mode) == shown);
    }
  }
}

TEST_CASE("colours of the palette are shown exactly") {
  for (int i = 16; i < 256; ++i) {
    const Rgb color = palette_color(static_cast<std::uint8_t>(i));
    CHECK(palette_color(quantise(Color::of(color), ColorMode::k256).index()) == color);
  }
  for (int i = 0; i < 16; ++i) {
    const auto index = static_cast<std::uint8_t>(i);
    CHECK(palette_color(quantise(Color::of(palette_color(index)), ColorMode::k16).index()) ==
          palette_color(index));
  }
}

TEST_CASE("at 256 colours every colour has an entry near it") {
  core::Random random(5);
  for (int i = 0; i < 5000; ++i) {
    const std::uint64_t bits = random.next();
    const Rgb color{static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
                    static_cast<std::uint8_t>(bits >> 16)};
    CHECK(distance(color, palette_color(quantise(Color::of(color), ColorMode::k256).index())) < 190);
  }
}

TEST_CASE("at 256 colours low ground stays blue, meadows green and heights warm in any light") {
  for (double brightness = 0.35; brightness <= 1.0; brightness += 0.01) {
    const auto shown = [&](double tone) {
      return palette_color(terrain_color(tone, brightness, ColorMode::k256).index());
    };
    const Rgb low = shown(0.02);
    CHECK(low.b > low.g);
    CHECK(low.b > low.r);
    const Rgb meadow = shown(0.48);
    CHECK(meadow.g >= meadow.r);
    CHECK(meadow.g > meadow.b);
    const Rgb rock = shown(0.8);
    CHECK(rock.r > rock.b);
  }
}

TEST_CASE("more light never makes ground darker") {
  const auto luminance = [](Rgb c) { return 2126 * c.r + 7152 * c.g + 722 * c.b; };
  for (double tone = 0.0; tone <= 1.0; tone += 1.0 / 64.0) {
    int before_256 = -1;
    int before_rgb = -1;
    for (double brightness = 0.3; brightness <= 1.0; brightness += 0.02) {
      const int at_256 = luminance(palette_color(terrain_color(tone, brightness, ColorMode::k256).index()));
      const int at_rgb = luminance(terrain_color(tone, brightness, ColorMode::kTruecolor).rgb);
      CHECK(at_256 >= before_256);
      CHECK(at_rgb >= before_rgb);
      before_256 = at_256;
      before_rgb = at_rgb;
    }
  }
}

TEST_CASE("an older trail is darker than the recent one in every colour mode") {
  const auto light = [](Color c) {
    const Rgb rgb = c.kind == Color::Kind::kRgb ? c.rgb : palette_color(c.index());
    return rgb.r + rgb.g + rgb.b;
  };
  for (const ColorMode mode : {ColorMode::k16, ColorMode::k256, ColorMode::kTruecolor})
    for (std::uint32_t id = 0; id < 30; ++id) {
      const Rgb color = louse_color(id, id == 7 ? Owner::kYou : Owner::kOther, {mode, GlyphSet::kAscii});
      CHECK(light(quantise(trail_color(color, TrailAge::kOld, mode), mode)) <
            light(quantise(trail_color(color, TrailAge::kRecent, mode), mode)));
    }
}
