// Grids that count their knots in degrees of longitude and latitude, laid out in metres.
#pragma once

#include "shared/core/vec2.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::elevation {

/// What the numbers of a file's frame are.
enum class LengthUnit {
  kByLooks,  ///< degrees where metres would be absurd (looks_like_degrees), else metres
  kMetres,
  kDegrees,
};

/// Metres a degree eastwards (x) and northwards (y) at `latitude` [degrees, -90 to 90] on the ellipsoid
/// WGS 84, by its usual series (error below 0.01 %). The same bits everywhere.
core::Vec2 metres_a_degree(double latitude);

/// The latitude in the middle of a frame in degrees, kept within +-89.
double middle_latitude(const terrain::GridFrame& frame);

/// Whether a frame can only be meant in degrees: it lies on the globe, its knots are at most 0.05 apart, and
/// were they metres, its ground would be steeper than 100 (`steepest`, between neighbouring knots, as if it
/// were in metres), which no map may be.
bool looks_like_degrees(const terrain::GridFrame& frame, double steepest);

/// The frame in metres: spacings and origin times metres_a_degree() of its middle latitude. Columns converge
/// towards the poles; a grid does not: at 45 degrees 1 % of its width for each degree from its middle.
terrain::GridFrame in_metres(const terrain::GridFrame& frame);

}  // namespace woodlouse::elevation
