// The game's colours: the terrain's ramps, the lice's, the panel's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// The terrain at a tone (0 lowest .. 1 highest) and brightness (0 black .. 1 fully lit). At 256 colours from
/// 16-step ramps of palette entries, else RGB.
Color terrain_color(double tone, double brightness, ColorMode mode);

/// The same hue, bright enough for thin lines on a dark ground.
Color contour_color(double tone);

/// Steepness 0 (level) .. 1 (the steepest), dark blue over magenta and orange to pale yellow.
Color slope_color(double steepness, ColorMode mode);

/// The sky behind an oblique view at a height 0 (top) .. 1 (bottom).
Color sky_color(double height, ColorMode mode);

/// The earth under the map's edge.
Color edge_color(double brightness, ColorMode mode);

enum class Owner : std::uint8_t { kYou, kOther };

/// How many colours the others have; then they repeat, with another coat (badges.h).
inline constexpr std::size_t kBadgeColors = 7;

/// A louse's own colour: yours is raspberry (violet for deuteranopes, mint for tritanopes), the others' go by
/// their id. Yours differs by 8 or more (Oklab times 100) from every ground, and any two from each other, in
/// true colour and in 256, for the eyes of the palette: palette_test.cpp prints the table. Of 16 colours the
/// terminal's own theme says how they look, and the palette does not matter.
Rgb louse_color(std::uint32_t id, Owner owner, const Look& look);

/// What is wanted of you is drawn in this, and nothing else: yellow, 8 or more from every louse. No colour
/// differs so much from every ground: on the ground it alternates with kMarkShade, one of which always does.
Rgb goal_color(const Look& look);
inline constexpr Rgb kMarkShade{10, 10, 16};

/// What is there and not wanted now: pale, 8 or more from every louse and from what is wanted.
enum class PaleMark : std::uint8_t { kGate, kCrumb, kRing, kGhost };
Rgb pale_color(PaleMark mark, const Look& look);

/// Of a pale mark and kMarkShade the one that is seen on this ground.
Rgb set_off(Rgb pale, Rgb ground);

/// A trail has two brightnesses, so that while it grows a frame changes at its two ends and in the middle
/// only.
enum class TrailAge : std::uint8_t { kRecent, kOld };
Color trail_color(Rgb louse, TrailAge age, ColorMode mode);

/// The panel's and the lines' styles for a look.
struct Styles {
  Style text;
  Style dim;      ///< frames, column heads
  Style strong;   ///< your own row, titles
  Style bar;      ///< status line and key line
  Style dim_bar;  ///< what matters less there
  Style warning;
};
Styles styles_for(const Look& look);

}  // namespace woodlouse::client
