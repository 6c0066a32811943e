// Any surface of the catalogue behind one indirect call a sample, so that steps over all of them are compiled
// once.
#pragma once

#include <variant>

#include "shared/document/surface_catalogue.h"

namespace woodlouse::document {

/// Refers to `surface`. Meets terrain::Surface; the samples of a surface without a Hessian hold NaN for it.
class IndirectSurface {
 public:
  explicit IndirectSurface(const AnySurface& surface) : surface_(surface) {}

  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    return std::visit([&](const auto& s) { return s.sample(x, y); }, surface_);
  }
  [[nodiscard]] terrain::Rectangle domain() const {
    return std::visit([](const auto& s) { return s.domain(); }, surface_);
  }
  [[nodiscard]] double cell() const {
    return std::visit([](const auto& s) { return s.cell(); }, surface_);
  }

 private:
  const AnySurface& surface_;
};

/// What physics::CompiledSteps samples on a ground of this type.
inline IndirectSurface surface_of(const AnySurface& ground) { return IndirectSurface(ground); }

}  // namespace woodlouse::document
