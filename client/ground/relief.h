// What painting a terrain needs to know of it as a whole: its heights' range and distribution, how steep it
// is, the light, and the shadow it casts on itself.
//
//     brightness = ambient + (1 - ambient) max(0, n . l)     Lambert, n the surface normal, l to the light
// with the light from the north-west, heights stretched by exaggeration() so that a flat map still shows its
// form. A point whose way to the light meets the terrain keeps the ambient part and a little of the rest.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "client/ground/height_ceiling.h"
#include "shared/core/vec2.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::client {

class Relief {
 public:
  explicit Relief(std::shared_ptr<const terrain::Terrain> terrain);

  [[nodiscard]] const terrain::Terrain& terrain() const { return *terrain_; }
  [[nodiscard]] const std::shared_ptr<const terrain::Terrain>& shared_terrain() const { return terrain_; }
  [[nodiscard]] double lowest() const { return heights_.front(); }  ///< [m]
  [[nodiscard]] double highest() const { return heights_.back(); }  ///< [m], > lowest by a hair at least
  /// The gradient's length that 5 % of the map exceed; > 0.
  [[nodiscard]] double steep() const { return steep_; }
  /// How many times too high the terrain is drawn where height is seen, 1..2.
  [[nodiscard]] double exaggeration() const { return exaggeration_; }
  /// -1..1: how much higher the rim lies than the middle; above 0.2 a pot, below -0.2 a hill.
  [[nodiscard]] double potness() const { return potness_; }

  /// The surface at a point, which is moved into the domain where it lies outside.
  [[nodiscard]] terrain::SurfaceSample sample(core::Vec2 p) const;
  /// A height that the ground at a point stays under [m].
  [[nodiscard]] double ceiling(core::Vec2 p) const { return ceiling_.at(p); }
  /// The height at a point; beyond the edge the edge's slope goes on.
  [[nodiscard]] double extended_height(core::Vec2 p) const;
  /// Where a height stands on the colour ramp, 0 lowest .. 1 highest: by height and by how much of the
  /// map lies below, so that the wide flat parts get colours too.
  [[nodiscard]] double tone(double z) const;
  /// kAmbient..1, shadow included.
  [[nodiscard]] double brightness(core::Vec2 p, const terrain::SurfaceSample& s) const;
  /// A map without heights: what of them differs is rounding. It has no contours, and tiles instead.
  [[nodiscard]] bool is_flat() const { return is_flat_; }
  /// The width of a flat map's tiles [m].
  [[nodiscard]] double tile() const { return tile_; }
  /// How much darker the tile at a point is; 1 where the map is not flat.
  [[nodiscard]] double tile_shade(core::Vec2 p) const;
  /// The step between contour lines, 1, 2 or 5 times a power of ten, such that where it is steep they are
  /// `distance` metres of the map apart or more.
  [[nodiscard]] double contour_interval(double distance) const;

  static constexpr double kAmbient = 0.48;

 private:
  /// How much of the light the terrain lets through: 0 full shadow .. 1 none.
  [[nodiscard]] double unshadowed(core::Vec2 p, double z) const;

  std::shared_ptr<const terrain::Terrain> terrain_;
  HeightCeiling ceiling_;
  std::vector<double> heights_;  ///< of a grid of points, ascending
  double steep_ = 0.0;
  double exaggeration_ = 1.0;
  double potness_ = 0.0;
  bool is_flat_ = false;
  double tile_ = 1.0;
};

/// The least of 1, 2, 5, 10, ... times a power of ten that is `least` or more. REQUIRES least > 0.
double round_step(double least);

/// What rises less than this part of the interval a step has no contours: they would be of its rounding.
inline constexpr double kLeastRise = 1e-6;

/// Where the shadow of what flies a metre high lies, seen from above: away from the light [m].
inline constexpr core::Vec2 kShadowWay{0.62 / 0.62, -0.48 / 0.62};

/// How far contour lines lie above multiples of their interval, in intervals: maps made of whole metres have
/// plains at those, on which a line would wander.
inline constexpr double kOffRound = 0.43;

/// Between which two contour lines a height lies.
inline double contour_number(double z, double interval) { return std::floor(z / interval - kOffRound); }

}  // namespace woodlouse::client
