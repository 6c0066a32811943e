// The document's figures, which are lost, drawn again from the methods themselves. Each function draws those
// of one place of the document, writes their numbers as a table, and notes what docs/document.md quotes.
//
// The text gives no initial conditions and no time step (the dialog of 2.1 was a picture), but "85 frames per
// second" (5.3): steps are 1/85 s. Gravity, drag and friction are the constants of 2.4.
#pragma once

#include <string>

#include "bench/lab/report/output.h"
#include "shared/core/error.h"
#include "shared/state/parameters.h"

namespace woodlouse::lab {

inline constexpr double kFrameRate = 85.0;  ///< [Hz]

/// gr, vd and mu of `Integ` (2.4.1); no thrust.
inline state::Parameters constants_of_integ(bool drag, bool friction) {
  return {9.810, drag ? 0.200 : 0.0, friction ? 0.050 : 0.0, 0.0, 1.0};
}

/// What a figure shows in a number.
class Findings {
 public:
  Findings() : table_({"figure", "what", "value", "unit"}) {}
  void note(const std::string& figure, const std::string& what, double value, const std::string& unit) {
    table_.add({figure, what, value, unit});
  }
  [[nodiscard]] const Table& table() const { return table_; }

 private:
  Table table_;
};

/// 2.2: a parabolic pot and a wavy one, with and without drag and friction; and what becomes of the energy.
core::Expected<void> draw_pots(const Output& output, Findings& findings);
/// 2.3: the celestial body.
core::Expected<void> draw_planet(const Output& output, Findings& findings);
/// 3.5: a trajectory on interpolated terrain, hidden where the terrain is before it.
core::Expected<void> draw_interpolated_terrain(const Output& output, Findings& findings);
/// 4.2: the surface without and with blending, by its normals.
core::Expected<void> draw_blending(const Output& output, Findings& findings);
/// 5.1: the splines that a value of the global spline is made of.
core::Expected<void> draw_global_spline(const Output& output, Findings& findings);
/// The map hoffmann_2002 as the document steps it, beside the exact motion.
core::Expected<void> draw_as_played(const Output& output, Findings& findings);

}  // namespace woodlouse::lab
