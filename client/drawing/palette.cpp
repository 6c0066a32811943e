#include "client/drawing/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "client/drawing/layout.h"

namespace woodlouse::client {
namespace {

struct Stop {
  double at;
  Rgb color;
};

template <std::size_t N>
Rgb along(const std::array<Stop, N>& ramp, double t) {
  for (std::size_t i = 1; i < N; ++i) {
    if (t > ramp[i].at) continue;
    return mix(ramp[i - 1].color, ramp[i].color,
               std::max(0.0, t - ramp[i - 1].at) / (ramp[i].at - ramp[i - 1].at));
  }
  return ramp.back().color;
}

/// Deep water, shallow water, meadow, straw, sandstone, rock, snow.
constexpr std::array<Stop, 8> kElevation = {{{0.00, {30, 66, 118}},
                                             {0.14, {38, 98, 142}},
                                             {0.28, {52, 140, 138}},
                                             {0.44, {104, 168, 98}},
                                             {0.60, {206, 192, 116}},
                                             {0.76, {222, 158, 108}},
                                             {0.90, {196, 138, 116}},
                                             {1.00, {250, 246, 238}}}};

constexpr std::array<Stop, 5> kSlope = {{{0.0, {14, 16, 52}},
                                         {0.25, {92, 30, 116}},
                                         {0.5, {186, 56, 96}},
                                         {0.75, {246, 140, 60}},
                                         {1.0, {252, 244, 170}}}};

/// The same by hand for the xterm palette: 16 tones, six brightnesses each from shadow to full light. A tone
/// keeps its hue down into the shadow; the nearest cube entry would not.
constexpr std::size_t kTones = 16;
constexpr std::size_t kLights = 6;
constexpr std::array<std::array<std::uint8_t, kLights>, kTones> kTerrain256 = {
    {{17, 17, 17, 24, 24, 25},
     {17, 17, 24, 24, 25, 25},
     {17, 23, 24, 24, 31, 31},
     {23, 23, 24, 30, 31, 31},
     {23, 23, 30, 30, 66, 73},
     {22, 23, 29, 66, 72, 72},
     {22, 22, 65, 65, 71, 72},
     {22, 58, 65, 65, 107, 107},
     {58, 58, 65, 101, 107, 143},
     {58, 58, 101, 101, 143, 143},
     {58, 94, 101, 137, 143, 179},
     {58, 94, 95, 137, 179, 179},
     {58, 94, 95, 137, 173, 180},
     {58, 95, 95, 137, 173, 180},
     {59, 95, 138, 138, 180, 187},
     {240, 243, 246, 249, 252, 255}}};
constexpr std::array<std::uint8_t, 16> kSlope256 = {17,  18,  54,  54,  53,  89,  90,  125,
                                                    131, 167, 173, 208, 214, 221, 228, 230};

/// By Palette. Those for other eyes are entries of the xterm cube, found by search (Machado, Oliveira and
/// Fernandes' matrices of 2009, severity 1).
struct LouseColors {
  Rgb you;
  std::array<Rgb, kBadgeColors> others;
  Rgb goal;  ///< also an entry of the cube
};
constexpr std::array<LouseColors, 3> kLice = {{{{255, 56, 112},
                                                {{{255, 205, 84},
                                                  {110, 214, 255},
                                                  {140, 250, 140},
                                                  {186, 138, 255},
                                                  {255, 156, 220},
                                                  {255, 165, 94},
                                                  {172, 240, 222}}},
                                                {255, 255, 95}},
                                               {{135, 95, 255},
                                                {{{215, 255, 0},
                                                  {95, 175, 255},
                                                  {135, 135, 0},
                                                  {135, 255, 255},
                                                  {175, 215, 135},
                                                  {215, 175, 215},
                                                  {95, 135, 175}}},
                                                {255, 255, 175}},
                                               {{0, 255, 175},
                                                {{{255, 135, 255},
                                                  {95, 135, 255},
                                                  {135, 215, 95},
                                                  {215, 255, 215},
                                                  {255, 0, 0},
                                                  {175, 95, 255},
                                                  {215, 0, 215}}},
                                                {255, 215, 95}}}};

/// Of the sixteen colours the bright ones but red and blue; blue drowns in many themes.
constexpr std::uint8_t kBrightRed = 9;
constexpr std::array<std::uint8_t, 4> kLice16 = {11, 14, 10, 13};

std::size_t step(double t, std::size_t steps) {
  const double scaled_up = std::clamp(t, 0.0, 1.0) * static_cast<double>(steps);
  return std::min(steps - 1, static_cast<std::size_t>(scaled_up));
}

}  // namespace

Color terrain_color(double tone, double brightness, ColorMode mode) {
  // Below 0.25 lie only contours in shadow.
  if (mode == ColorMode::k256)
    return Color::indexed(kTerrain256[step(tone, kTones)][step((brightness - 0.25) / 0.75, kLights)]);
  return Color::of(scaled(along(kElevation, tone), brightness));
}

Color contour_color(double tone) { return Color::of(mix(along(kElevation, tone), {255, 255, 255}, 0.28)); }

Color slope_color(double steepness, ColorMode mode) {
  if (mode == ColorMode::k256) return Color::indexed(kSlope256[step(steepness, kSlope256.size())]);
  return Color::of(along(kSlope, std::clamp(steepness, 0.0, 1.0)));
}

Color sky_color(double height, ColorMode mode) {
  if (mode == ColorMode::k256) return Color::indexed(234);
  return Color::of(mix({34, 36, 54}, {12, 14, 20}, height));
}

Color edge_color(double brightness, ColorMode mode) {
  if (mode == ColorMode::k256) return Color::indexed(brightness > 0.7 ? 238 : 236);
  return Color::of(scaled({72, 62, 54}, brightness));
}

Rgb louse_color(std::uint32_t id, Owner owner, const Look& look) {
  if (look.color == ColorMode::k16)
    return palette_color(owner == Owner::kYou ? kBrightRed : kLice16[id % kLice16.size()]);
  const LouseColors& colors = kLice[static_cast<std::size_t>(look.palette)];
  return owner == Owner::kYou ? colors.you : colors.others[id % kBadgeColors];
}

Rgb goal_color(const Look& look) { return kLice[static_cast<std::size_t>(look.palette)].goal; }

Rgb pale_color(PaleMark mark, const Look& look) {
  constexpr std::array<Rgb, 4> kUsual = {
      {{176, 184, 206}, {255, 250, 225}, {240, 242, 250}, {214, 222, 255}}};
  switch (look.palette) {  // the others have lice that are pale, too
    case Palette::kDeutan:
      return {255, 255, 255};
    case Palette::kTritan:
      return {198, 198, 198};
    case Palette::kDefault:
      break;
  }
  return kUsual[static_cast<std::size_t>(mark)];
}

Rgb set_off(Rgb pale, Rgb ground) {
  constexpr double kBright = 120.0;  // of 255
  return 0.299 * ground.r + 0.587 * ground.g + 0.114 * ground.b < kBright ? pale : kMarkShade;
}

Color trail_color(Rgb louse, TrailAge age, ColorMode mode) {
  const Color color = Color::of(louse);
  if (age == TrailAge::kRecent) return color;
  if (mode != ColorMode::k16) return Color::of(scaled(louse, 0.6));
  const std::uint8_t index = quantise(color, mode).index();
  return Color::indexed(index > 8 ? static_cast<std::uint8_t>(index - 8) : index);
}

Styles styles_for(const Look& look) {
  Styles styles;
  styles.strong.attributes = kBold;
  if (look.color == ColorMode::kMono) {
    styles.warning.attributes = kReverse;
    return styles;
  }
  const auto rgb = [](std::uint8_t r, std::uint8_t g, std::uint8_t b) { return Color::of({r, g, b}); };
  if (look.color == ColorMode::k16) {
    styles.bar = {Color::indexed(15), {}, kBold};
    styles.dim.foreground = styles.dim_bar.foreground = Color::indexed(6);
    styles.warning = {Color::indexed(11), {}, kBold};
    return styles;
  }
  const Color ground =
      paints_pixels(look) ? (look.color == ColorMode::k256 ? Color::indexed(233) : rgb(18, 20, 26)) : Color{};
  styles.text = {rgb(214, 216, 222), ground, kPlain};
  styles.dim = {rgb(116, 122, 138), ground, kPlain};
  styles.strong = {rgb(255, 255, 255), ground, kBold};
  styles.bar = {rgb(230, 232, 240), look.color == ColorMode::k256 ? Color::indexed(236) : rgb(34, 37, 50),
                kPlain};
  styles.dim_bar = {rgb(150, 156, 172), styles.bar.background, kPlain};
  styles.warning = {rgb(255, 214, 102), ground, kBold};
  return styles;
}

}  // namespace woodlouse::client
