// From the heights of somebody's file to ground that can be played on: degrees become metres, a rim without
// data is cut off, holes are filled. One line tells what was done.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/elevation/degrees.h"
#include "shared/terrain/height_grid.h"

namespace woodlouse::elevation {

/// Heights from here on are no data, whatever a file declares: writers round -3.4e38 each in their way.
inline constexpr double kNoHeightFrom = 1e30;

/// A grid as its file has it: the file's units; NaN where it has no data.
struct FileGrid : terrain::HeightGrid {
  /// A height that was taken for none although the file does not say so.
  std::optional<double> undeclared_mark;
};

/// What files that declare no mark customarily have in its place.
inline constexpr std::array<double, 4> kCustomaryMarks = {-9999.0, -32768.0, -32767.0, -99999.0};

/// In a grid whose file declares no mark: if heights are exactly one of kCustomaryMarks, the first of these
/// that occurs becomes NaN, and is noted.
void take_undeclared_mark(FileGrid& grid);

/// What the note says of such a mark: "-9999 was taken for no data, which the file does not say".
std::string mark_note(double mark);

/// What a map wants of a grid that has holes.
enum class Rim {
  kCut,   ///< rows and columns at the rim that have no datum at all are cut off
  kFill,  ///< they are filled as all else
};

struct GroundOptions {
  Rim rim = Rim::kCut;
  LengthUnit unit = LengthUnit::kByLooks;
  double scale = 1.0;  ///< > 0, on lengths and heights alike
  /// Given: holes are filled as those of tiles (terrain/fill_missing.h), and their depths have this height
  /// [m, after the scale]. Else by the harmonic fill of terrain/harmonic_fill.h.
  std::optional<double> fill_level;
};

struct Ground {
  terrain::HeightGrid grid;  ///< finite heights in metres, its middle at (0, 0)
  std::string note;          ///< one line; empty: nothing was done
};

/// Errors, with `source` as their place: no data at all, or less than 4 knots each way with the rim cut off.
core::Expected<Ground> make_ground(FileGrid file, const GroundOptions& options, const std::string& source);

/// What the note says of degrees, of a frame in them: "degrees at latitude 44.00: 22.26 m by 30.87 m a cell".
std::string degrees_note(const terrain::GridFrame& frame);

/// The steepest of the slopes between neighbouring knots that both have data, in the grid's own units.
double steepest_step(const terrain::HeightGrid& grid);

}  // namespace woodlouse::elevation
