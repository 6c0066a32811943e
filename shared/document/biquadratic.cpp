#include "shared/document/biquadratic.h"

#include <cassert>

namespace woodlouse::document {

Biquadratic::Biquadratic(terrain::HeightGrid grid)
    : grid_(std::move(grid)),
      domain_(grid_.domain()),
      inverse_dx_(1.0 / grid_.dx),
      inverse_dy_(1.0 / grid_.dy) {
  assert(grid_.columns >= 3 && grid_.rows >= 3 && grid_.dx > 0.0 && grid_.dy > 0.0);
  assert(grid_.heights.size() == grid_.columns * grid_.rows);
}

}  // namespace woodlouse::document
