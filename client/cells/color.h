// Colours of cells and what a terminal can show of them.
//
// A colour is made once, by whoever draws: at 256 colours the terrain comes from hand-picked ramps of the
// xterm palette (the nearest entry of its 6x6x6 cube turns deep blue to teal), everything else by the nearest
// entry in a perceptual space. What is still RGB when a frame is written is quantised there.
#pragma once

#include <cstdint>

namespace woodlouse::client {

/// What the terminal shows.
enum class ColorMode : std::uint8_t { kMono, k16, k256, kTruecolor };

/// Red, green, blue, 0..255.
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  friend constexpr bool operator==(Rgb, Rgb) = default;
};

/// A cell's colour: the terminal's own, an entry of its palette, or RGB.
struct Color {
  enum class Kind : std::uint8_t { kDefault, kIndexed, kRgb };

  Kind kind = Kind::kDefault;
  Rgb rgb;  ///< kRgb: the colour; kIndexed: the index stands in r; kDefault: zero

  static constexpr Color of(Rgb value) { return {Kind::kRgb, value}; }
  static constexpr Color indexed(std::uint8_t index) { return {Kind::kIndexed, {index, 0, 0}}; }
  [[nodiscard]] constexpr std::uint8_t index() const { return rgb.r; }
  friend constexpr bool operator==(Color, Color) = default;
};

/// The colour as `mode` can show it: kDefault for mono, an index below 16 or below 256, or RGB unchanged.
Color quantise(Color color, ColorMode mode);

/// What entry `index` of the xterm palette looks like.
Rgb palette_color(std::uint8_t index);

/// a + (b - a) * t, per channel; t in [0, 1].
Rgb mix(Rgb a, Rgb b, double t);

/// Each channel times `factor` >= 0, saturating.
Rgb scaled(Rgb color, double factor);

}  // namespace woodlouse::client
