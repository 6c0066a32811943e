#include "client/cells/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace woodlouse::client {
namespace {

constexpr std::array<std::uint8_t, 6> kCubeLevels = {0, 95, 135, 175, 215, 255};

/// xterm's sixteen, whose real look is the user's theme.
constexpr std::array<Rgb, 16> kSixteen = {{{0, 0, 0},
                                           {205, 0, 0},
                                           {0, 205, 0},
                                           {205, 205, 0},
                                           {0, 0, 238},
                                           {205, 0, 205},
                                           {0, 205, 205},
                                           {229, 229, 229},
                                           {127, 127, 127},
                                           {255, 0, 0},
                                           {0, 255, 0},
                                           {255, 255, 0},
                                           {92, 92, 255},
                                           {255, 0, 255},
                                           {0, 255, 255},
                                           {255, 255, 255}}};

/// Lightness and two opponent colours in which equal distances look equally different (Ottosson's Oklab,
/// 2020).
struct Lab {
  double l = 0.0;
  double a = 0.0;
  double b = 0.0;
};

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Lab to_lab(Rgb color) {
  const double r = linear(color.r);
  const double g = linear(color.g);
  const double b = linear(color.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

/// Which entry from `first` to `last` looks most like each of 32x32x32 colours.
class NearestTable {
 public:
  NearestTable(std::uint8_t first, std::uint8_t last) : nearest_(32 * 32 * 32) {
    std::vector<Lab> palette;
    for (int i = first; i <= last; ++i)
      palette.push_back(to_lab(palette_color(static_cast<std::uint8_t>(i))));
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      const Lab wanted = to_lab({widen(i >> 10), widen((i >> 5) & 31), widen(i & 31)});
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < palette.size(); ++k) {
        const double dl = palette[k].l - wanted.l;
        const double da = palette[k].a - wanted.a;
        const double db = palette[k].b - wanted.b;
        // A wrong hue is seen before a wrong lightness.
        const double distance = dl * dl + 2.0 * (da * da + db * db);
        if (distance >= best) continue;
        best = distance;
        nearest_[i] = static_cast<std::uint8_t>(first + k);
      }
    }
  }

  [[nodiscard]] std::uint8_t operator()(Rgb c) const {
    return nearest_[static_cast<std::size_t>(((c.r >> 3) << 10) | ((c.g >> 3) << 5) | (c.b >> 3))];
  }

 private:
  static std::uint8_t widen(std::size_t five_bits) {
    return static_cast<std::uint8_t>((five_bits << 3) | (five_bits >> 2));
  }

  std::vector<std::uint8_t> nearest_;
};

/// 0..5 for a channel that is one of the cube's levels, else -1.
int cube_level(std::uint8_t channel) {
  const auto found = std::find(kCubeLevels.begin(), kCubeLevels.end(), channel);
  return found == kCubeLevels.end() ? -1 : static_cast<int>(found - kCubeLevels.begin());
}

std::uint8_t nearest_of_256(Rgb c) {
  const int r = cube_level(c.r);
  const int g = cube_level(c.g);
  const int b = cube_level(c.b);
  if (r >= 0 && g >= 0 && b >= 0) return static_cast<std::uint8_t>(16 + 36 * r + 6 * g + b);
  if (c.r == c.g && c.g == c.b && c.r >= 8 && c.r <= 238 && (c.r - 8) % 10 == 0)
    return static_cast<std::uint8_t>(232 + (c.r - 8) / 10);
  static const NearestTable table(16, 255);
  return table(c);
}

std::uint8_t nearest_of_16(Rgb c) {
  for (std::size_t i = 0; i < kSixteen.size(); ++i)
    if (kSixteen[i] == c) return static_cast<std::uint8_t>(i);
  static const NearestTable table(0, 15);
  return table(c);
}

std::uint8_t to_channel(double value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0) + 0.5);
}

}  // namespace

Rgb palette_color(std::uint8_t index) {
  if (index < 16) return kSixteen[index];
  if (index >= 232) {
    const auto gray = static_cast<std::uint8_t>(8 + 10 * (index - 232));
    return {gray, gray, gray};
  }
  const int i = index - 16;
  const auto level = [](int k) { return kCubeLevels[static_cast<std::size_t>(k)]; };
  return {level(i / 36), level(i / 6 % 6), level(i % 6)};
}

Color quantise(Color color, ColorMode mode) {
  if (color.kind == Color::Kind::kDefault || mode == ColorMode::kMono) return {};
  if (mode == ColorMode::kTruecolor) return color;
  if (color.kind == Color::Kind::kIndexed) {
    if (mode == ColorMode::k256 || color.index() < 16) return color;
    return Color::indexed(nearest_of_16(palette_color(color.index())));
  }
  return Color::indexed(mode == ColorMode::k256 ? nearest_of_256(color.rgb) : nearest_of_16(color.rgb));
}

Rgb mix(Rgb a, Rgb b, double t) {
  const auto channel = [t](std::uint8_t from, std::uint8_t to) {
    return to_channel(static_cast<double>(from) + (static_cast<double>(to) - static_cast<double>(from)) * t);
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

Rgb scaled(Rgb color, double factor) {
  return {to_channel(color.r * factor), to_channel(color.g * factor), to_channel(color.b * factor)};
}

}  // namespace woodlouse::client
