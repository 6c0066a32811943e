// Whether lice are told apart, and yours from the ground, by eyes of each kind: simulated after Machado,
// Oliveira and Fernandes, "A Physiologically-based Model for Simulation of Color Vision Deficiency" (2009),
// severity 1, in linear light, and measured in Oklab. Prints the table.
#include "client/drawing/palette.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <vector>

#include "client/drawing/compose.h"
#include "client/drawing/layout.h"
#include "client/drawing/pixels.h"
#include "tests/client/drawing/shipped_maps.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

Triple times(const Matrix& m, const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

constexpr std::array<Matrix, 3> kEyes = {
    {{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};

/// Oklab times 100 of what eyes of a palette see.
Triple seen(Rgb color, Palette palette) {
  const auto linear = [](std::uint8_t channel) {
    const double c = channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  Triple light =
      times(kEyes[static_cast<std::size_t>(palette)], {linear(color.r), linear(color.g), linear(color.b)});
  for (double& c : light) c = std::min(1.0, std::max(0.0, c));
  constexpr Matrix kCones = {{{0.4122214708, 0.5363325363, 0.0514459929},
                              {0.2119034982, 0.6806995451, 0.1073969566},
                              {0.0883024619, 0.2817188376, 0.6299787005}}};
  constexpr Matrix kOpponents = {{{0.2104542553, 0.7936177850, -0.0040720468},
                                  {1.9779984951, -2.4285922050, 0.4505937099},
                                  {0.0259040371, 0.7827717662, -0.8086757660}}};
  Triple cones = times(kCones, light);
  for (double& c : cones) c = std::cbrt(c);
  Triple lab = times(kOpponents, cones);
  for (double& c : lab) c *= 100.0;
  return lab;
}

double difference(const Triple& a, const Triple& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Rgb as_shown(Rgb color, ColorMode mode) { return rgb_of(quantise(Color::of(color), mode)); }

/// Whatever the ground can be painted in: the ramps from shadow to full light, and every shipped map as
/// drawn.
std::vector<Rgb> grounds(ColorMode mode) {
  std::vector<Rgb> colors;
  const auto add = [&](Color color) { colors.push_back(rgb_of(quantise(color, mode))); };
  for (int i = 0; i <= 100; ++i) {
    for (int k = 30; k <= 100; k += 2) add(terrain_color(i / 100.0, k / 100.0, mode));
    add(slope_color(i / 100.0, mode));
    add(sky_color(i / 100.0, mode));
  }
  add(edge_color(0.7, mode));
  add(edge_color(1.0, mode));
  for (const auto& map : shipped_maps()) {
    Scene scene = scene_of(*map, {mode, GlyphSet::kHalfBlocks}, View::kMap);
    scene.landmarks.edges = state::Edges::kOpen;
    for (const View view : {View::kMap, View::kOblique, View::kSlope}) {
      scene.view = view;
      CellBuffer cells({60, 20});
      Composer().draw(scene, cells);
      const Viewport part = layout_for(cells.size(), scene.look).map;
      for (int row = 0; row < part.size.rows - 1; ++row)
        for (int column = 0; column < part.size.columns; ++column) {
          const Cell& cell = cells.at(part.column + column, part.row + row);
          if (cell.glyph != kUpperHalfBlock) continue;
          add(cell.style.foreground);
          add(cell.style.background);
        }
    }
  }
  return colors;
}

}  // namespace

TEST_CASE("yours differs from every ground, and lice from each other, for the eyes of each palette") {
  constexpr double kTold = 8.0;
  constexpr std::array<const char*, 3> kNames = {"default", "deutan ", "tritan "};
  std::cout << "palette  colours    you:ground  you:others  others\n";
  for (const ColorMode mode : {ColorMode::kTruecolor, ColorMode::k256}) {
    const std::vector<Rgb> ground = grounds(mode);
    for (const Palette palette : {Palette::kDefault, Palette::kDeutan, Palette::kTritan}) {
      const Look look{mode, GlyphSet::kHalfBlocks, palette};
      const Triple you = seen(as_shown(louse_color(1, Owner::kYou, look), mode), palette);
      double from_ground = 1e9, from_others = 1e9, between = 1e9;
      for (const Rgb color : ground)
        from_ground = std::min(from_ground, difference(you, seen(color, palette)));
      std::vector<Triple> others;
      for (std::uint32_t id = 0; id < kBadgeColors; ++id) {
        const Rgb color = as_shown(louse_color(id, Owner::kOther, look), mode);
        const Triple one = seen(color, palette);
        from_others = std::min(from_others, difference(you, one));
        for (const Triple& other : others) between = std::min(between, difference(one, other));
        others.push_back(one);
      }
      std::cout << kNames[static_cast<std::size_t>(palette)]
                << (mode == ColorMode::k256 ? "  256       " : "  truecolor ") << ' '
                << std::round(10 * from_ground) / 10 << "        " << std::round(10 * from_others) / 10
                << "        " << std::round(10 * between) / 10 << '\n';
      CHECK(from_ground >= kTold);
      CHECK(from_others >= kTold);
      CHECK(between >= kTold);
    }
  }
}

TEST_CASE(
    "marks of the modes differ from the ground, and what is wanted from lice, for the eyes of each palette") {
  constexpr double kTold = 8.0;
  constexpr std::array kMarks = {PaleMark::kGate, PaleMark::kCrumb, PaleMark::kRing, PaleMark::kGhost};
  constexpr double kWeakest = 0.4,
                   kWeakestGate = 0.5;  // of what ghosts and a ring that comes are laid on with
  std::cout << "palette  colours    goal:ground  goal:lice  pale marks:ground  pale marks:lice, goal\n";
  constexpr std::array<const char*, 3> kNames = {"default", "deutan ", "tritan "};
  for (const ColorMode mode : {ColorMode::kTruecolor, ColorMode::k256}) {
    const std::vector<Rgb> ground = grounds(mode);
    for (const Palette palette : {Palette::kDefault, Palette::kDeutan, Palette::kTritan}) {
      const Look look{mode, GlyphSet::kHalfBlocks, palette};
      const Triple goal = seen(as_shown(goal_color(look), mode), palette);
      const Triple shade = seen(as_shown(kMarkShade, mode), palette);
      double goal_ground = 1e9, goal_lice = 1e9, pale_ground = 1e9;
      for (const Rgb color : ground) {
        const Triple below = seen(color, palette);
        goal_ground = std::min(goal_ground, std::max(difference(goal, below), difference(shade, below)));
        for (const PaleMark mark : kMarks) {
          const double strength = mark == PaleMark::kGate ? kWeakestGate : kWeakest;
          const Rgb laid_on = as_shown(mix(color, set_off(pale_color(mark, look), color), strength), mode);
          pale_ground = std::min(pale_ground, difference(seen(laid_on, palette), below));
        }
      }
      std::vector<Triple> lice{seen(as_shown(louse_color(0, Owner::kYou, look), mode), palette)};
      for (std::uint32_t id = 0; id < kBadgeColors; ++id)
        lice.push_back(seen(as_shown(louse_color(id, Owner::kOther, look), mode), palette));
      for (const Triple& louse : lice) goal_lice = std::min(goal_lice, difference(goal, louse));
      lice.push_back(goal);
      double pale_lice = 1e9;
      for (const PaleMark mark : kMarks)
        for (const Triple& louse : lice)
          pale_lice =
              std::min(pale_lice, difference(seen(as_shown(pale_color(mark, look), mode), palette), louse));
      std::cout << kNames[static_cast<std::size_t>(palette)]
                << (mode == ColorMode::k256 ? "  256       " : "  truecolor ") << ' '
                << std::round(10 * goal_ground) / 10 << "         " << std::round(10 * goal_lice) / 10
                << "       " << std::round(10 * pale_ground) / 10 << "               "
                << std::round(10 * pale_lice) / 10 << '\n';
      CHECK(goal_ground >= kTold);
      CHECK(goal_lice >= kTold);
      CHECK(pale_ground >= kTold);
      CHECK(pale_lice >= kTold);
    }
  }
}

TEST_CASE("the simulated eyes see what they are known to confuse as one, and normal ones do not") {
  const Rgb red{200, 80, 60}, green{121, 119, 60};
  CHECK(difference(seen(red, Palette::kDefault), seen(green, Palette::kDefault)) > 15.0);
  CHECK(difference(seen(red, Palette::kDeutan), seen(green, Palette::kDeutan)) < 6.0);
  const Rgb white{255, 255, 255};
  for (const Palette palette : {Palette::kDeutan, Palette::kTritan})
    CHECK(difference(seen(white, palette), seen(white, Palette::kDefault)) < 0.5);
}
